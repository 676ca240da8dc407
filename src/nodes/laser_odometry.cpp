#include <memory>

#include <ros/ros.h>

#include "nodes/laser_odometry_config.h"
#include "nodes/odometry_controls.h"
#include "sightline/bridge/live_feed.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/parameters.h"

namespace sightline::nodes {

namespace {

using pipeline::OdometrySource;

pipeline::EstimatorsConfig estimatorsOf(const LaserOdometryNodeConfig& config) {
  pipeline::EstimatorsConfig result;
  result.input = config.topics.input;
  result.frames = config.topics.frames;
  result.odometry = config.odometry;
  return result;
}

// Keeps the node from taking its own output for a prior.
OdometrySource sourceOf(const LaserOdometryNodeConfig& config, const ros::NodeHandle& node) {
  const auto& input = config.topics.input;
  const OdometrySource asked = input.feed.odometry_source;
  const bool is_own = node.resolveName(input.odometry_topic) == node.resolveName("laser_odom");
  if (asked == OdometrySource::kAutomatic && config.publish_tf) {
    return is_own ? OdometrySource::kNone : OdometrySource::kTopic;
  }
  if (asked == OdometrySource::kAutomatic && is_own) return OdometrySource::kTransforms;
  return asked;
}

LaserOdometryNodeConfig readLaserOdometryConfig(const ros::NodeHandle& node,
                                                const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<LaserOdometryNodeConfig>(private_node);
  config.topics.input.feed.odometry_source = sourceOf(config, node);
  config.topics.frames = config.topics.frames.withoutSlashes();
  return config;
}

class LaserOdometryNode {
 public:
  LaserOdometryNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(readLaserOdometryConfig(node, private_node)),
        estimators_(estimatorsOf(config_), kOdometry),
        diagnostics_(node, private_node),
        output_(node),
        odometry_(output_, config_.topics.frames, config_.publish_tf),
        controls_(private_node, *estimators_.odometry(), odometry_, diagnostics_.updater()),
        feed_(node, config_.topics.input, config_.topics.frames, {}, diagnostics_.updater(),
              [this](pipeline::LocatedScan located) { reckon(std::move(located)); }) {}

 private:
  static constexpr pipeline::EstimatorSet kOdometry{false, false, true};

  void reckon(pipeline::LocatedScan located) {
    const auto estimates = estimators_.take(std::move(located));
    const std::string reason = odometry_.write(estimates);
    controls_.note(estimates);
    if (!reason.empty()) throw bridge::UnusedScan(reason, false);
  }

  LaserOdometryNodeConfig config_;
  pipeline::Estimators estimators_;
  bridge::NodeDiagnostics diagnostics_;
  bridge::Output output_;
  bridge::OdometryOutput odometry_;
  OdometryControls controls_;
  bridge::LiveFeed feed_;
};

}  // namespace

std::shared_ptr<void> makeLaserOdometry(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<LaserOdometryNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
