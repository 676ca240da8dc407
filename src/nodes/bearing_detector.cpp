#include <memory>
#include <utility>

#include <ros/ros.h>

#include "nodes/bearing_detector_config.h"
#include "sightline/bridge/bearing_output.h"
#include "sightline/bridge/live_feed.h"
#include "sightline/bridge/log_throttle.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/parameters.h"

namespace sightline::nodes {

namespace {

BearingDetectorNodeConfig readBearingDetectorConfig(const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<BearingDetectorNodeConfig>(private_node);
  config.detector.check(private_node.getNamespace());
  if (!config.fixed_frame.empty()) config.topics.frames.odom = config.fixed_frame;
  config.topics.frames = config.topics.frames.withoutSlashes();
  return config;
}

/// Bearings of the reflective targets that a laser scanner sees.
class BearingDetectorNode {
 public:
  BearingDetectorNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(readBearingDetectorConfig(private_node)),
        diagnostics_(node, private_node),
        output_(node),
        bearings_(output_, config_.detector),
        feed_(node, config_.topics.input, config_.topics.frames,
              {!config_.fixed_frame.empty(), !config_.fixed_frame.empty()}, diagnostics_.updater(),
              [this](const pipeline::LocatedScan& located) { take(located); }) {
    diagnostics_.updater().add("bearings", this, &BearingDetectorNode::report);
  }

 private:
  void take(const pipeline::LocatedScan& located) {
    const bool was_blind = std::exchange(is_blind_, located.scan.intensities().empty());
    if (!is_blind_) return bearings_.write(located);
    if (!was_blind && blindness_.isDue()) {
      ROS_ERROR(
          "scans of '%s' without intensities: no target can be told from a wall; tell the "
          "driver of the scanner to send them",
          located.scan.frame.c_str());
    }
    throw bridge::UnusedScan("no intensities", /*blameless=*/true);
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(is_blind_ ? DiagnosticStatus::ERROR : DiagnosticStatus::OK,
                   is_blind_ ? "scans without intensities" : "detecting");
    status.add("scans", bearings_.scans());
    status.add("scans without a bearing", bearings_.emptySets());
    status.add("bearings", bearings_.bearings());
  }

  BearingDetectorNodeConfig config_;
  bridge::NodeDiagnostics diagnostics_;
  bridge::Output output_;
  bridge::BearingOutput bearings_;
  bridge::LiveFeed feed_;
  bool is_blind_ = false;  // the last scan came without intensities
  bridge::LogThrottle blindness_;
};

}  // namespace

std::shared_ptr<void> makeBearingDetector(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<BearingDetectorNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
