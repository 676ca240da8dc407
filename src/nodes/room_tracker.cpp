#include <memory>

#include <ros/ros.h>

#include "nodes/room_controls.h"
#include "nodes/room_tracker_config.h"
#include "sightline/bridge/last_pose.h"
#include "sightline/bridge/live_feed.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/parameters.h"

namespace sightline::nodes {

namespace {

pipeline::EstimatorsConfig estimatorsOf(const RoomTrackerNodeConfig& config) {
  pipeline::EstimatorsConfig result;
  result.input = config.topics.input;
  result.frames = config.topics.frames;
  result.rooms = config.rooms;
  return result;
}

RoomTrackerNodeConfig readRoomTrackerConfig(const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<RoomTrackerNodeConfig>(private_node);
  if (config.rooms.map.empty()) {
    throw config::Error(private_node.getNamespace(), 0, "map", "has to name a rooms file");
  }
  config.topics.frames = config.topics.frames.withoutSlashes();
  if (!config.rooms.initial_pose) {
    config.rooms.initial_pose = bridge::LastPose(config.last_pose).read();
  }
  return config;
}

class RoomTrackerNode {
 public:
  RoomTrackerNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(readRoomTrackerConfig(private_node)),
        estimators_(estimatorsOf(config_), kRooms),
        last_pose_(config_.last_pose),
        diagnostics_(node, private_node),
        output_(node),
        rooms_(output_, config_.output, config_.topics.frames, config_.rooms,
               estimators_.rooms()->map()),
        controls_(node, private_node, config_.rooms, config_.topics.frames.map,
                  *estimators_.rooms(), rooms_, diagnostics_.updater()),
        feed_(node, config_.topics.input, config_.topics.frames, {}, diagnostics_.updater(),
              [this](pipeline::LocatedScan located) { track(std::move(located)); }) {
    const double rate = config_.output.transform_rate;
    if (rate == 0.0) return;
    resend_timer_ = node.createSteadyTimer(
        ros::WallDuration(1.0 / rate),
        [this](const ros::SteadyTimerEvent&) { rooms_.resend(ros::Time::now()); });
  }

 private:
  static constexpr pipeline::EstimatorSet kRooms{false, true, false};

  void track(pipeline::LocatedScan located) {
    const auto estimates = estimators_.take(std::move(located));
    const bool has_pose = estimators_.rooms()->hasPose();
    const std::string reason = rooms_.write(estimates, has_pose);
    if (estimates.rooms && !last_pose_.keep(*estimates.rooms)) {
      ROS_WARN_THROTTLE(60.0, "the pose cannot be kept in %s", config_.last_pose.c_str());
    }
    if (reason.empty() || !has_pose) return;
    throw bridge::UnusedScan(reason, estimates.located.before_odometry);
  }

  RoomTrackerNodeConfig config_;
  pipeline::Estimators estimators_;
  bridge::LastPose last_pose_;
  bridge::NodeDiagnostics diagnostics_;
  bridge::Output output_;
  bridge::RoomOutput rooms_;
  RoomControls controls_;
  bridge::LiveFeed feed_;
  ros::SteadyTimer resend_timer_;
};

}  // namespace

std::shared_ptr<void> makeRoomTracker(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<RoomTrackerNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
