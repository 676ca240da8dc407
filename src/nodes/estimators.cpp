#include <memory>
#include <optional>

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "nodes/line_controls.h"
#include "nodes/odometry_controls.h"
#include "nodes/room_controls.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/bridge/feature_output.h"
#include "sightline/bridge/line_output.h"
#include "sightline/bridge/live_feed.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/pipeline/estimators_config.h"

namespace sightline::nodes {

namespace {

/// The estimators that a configuration file asks for, live, on one feed: the file is the one that
/// `offline` takes. Lines of every scanner, the room tracker where there is a rooms file, and the
/// odometry from scans where something is said about it.
class EstimatorsNode {
 public:
  EstimatorsNode(ros::NodeHandle node, ros::NodeHandle private_node,
                 const pipeline::EstimatorsConfig& config)
      : set_{true, config.rooms.has_value(), config.odometry.has_value(), true},
        estimators_(config, set_),
        diagnostics_(node, private_node),
        output_(node),
        lines_(output_, config.input),
        features_(output_, config.frames),
        line_controls_(ros::NodeHandle(node, "line_extractor"), config.lines, estimators_) {
    broadcaster_.sendTransform(bridge::mountingTransforms(config).transforms);
    if (set_.rooms) addRooms(node, config);
    if (set_.odometry) {
      odometry_.emplace(output_, config.frames, /*publish_tf=*/false);
      odometry_controls_.emplace(ros::NodeHandle(node, "laser_odometry"), *estimators_.odometry(),
                                 *odometry_, diagnostics_.updater());
    }
    feed_.emplace(node, config.input, config.frames, pipeline::FeedNeeds{}, diagnostics_.updater(),
                  [this](pipeline::LocatedScan located) { take(std::move(located)); });
  }

 private:
  void addRooms(const ros::NodeHandle& node, const pipeline::EstimatorsConfig& config) {
    const auto& map = estimators_.rooms()->map();
    rooms_.emplace(output_, bridge::RoomOutputConfig{true, 0.1}, config.frames, *config.rooms, map);
    room_controls_.emplace(node, ros::NodeHandle(node, "room_tracker"), *config.rooms,
                           config.frames.map, *estimators_.rooms(), *rooms_,
                           diagnostics_.updater());
  }

  void take(pipeline::LocatedScan located) {
    const auto estimates = estimators_.take(std::move(located));
    lines_.write(estimates);
    features_.write(estimates);
    if (odometry_) {
      odometry_->write(estimates);
      odometry_controls_->note(estimates);
    }
    if (rooms_) rooms_->write(estimates, estimators_.rooms()->hasPose());
  }

  pipeline::EstimatorSet set_;
  pipeline::Estimators estimators_;
  bridge::NodeDiagnostics diagnostics_;
  bridge::Output output_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  bridge::LineOutput lines_;
  bridge::FeatureOutput features_;
  LineControls line_controls_;
  std::optional<bridge::RoomOutput> rooms_;
  std::optional<RoomControls> room_controls_;
  std::optional<bridge::OdometryOutput> odometry_;
  std::optional<OdometryControls> odometry_controls_;
  std::optional<bridge::LiveFeed> feed_;
};

}  // namespace

std::shared_ptr<void> makeEstimators(ros::NodeHandle node, ros::NodeHandle private_node) {
  const auto path = private_node.param<std::string>("config", "");
  if (path.empty()) {
    throw config::Error(private_node.getNamespace(), 0, "config",
                        "has to name a configuration file");
  }
  return std::make_shared<EstimatorsNode>(node, private_node,
                                          pipeline::EstimatorsConfig::readFile(path));
}

}  // namespace sightline::nodes
