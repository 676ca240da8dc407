#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/ros.h>
#include <sightline/BearingArray.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/config/error.h"
#include "sightline/pipeline/bearing_feed.h"

namespace sightline::bridge {

/// Hands the bearings of a team, and the poses of its sensors, from topics to a feed, and counts
/// them robot by robot. Without a topic of poses it fills the buffer with transforms instead.
class TeamInput {
 public:
  /// What a node does after each message.
  using After = std::function<void()>;

  /// `updater`, `buffer` and `feed` have to live as long.
  TeamInput(ros::NodeHandle node, pipeline::BearingTopics team,
            diagnostic_updater::Updater& updater, tf2_ros::Buffer& buffer,
            pipeline::BearingFeed& feed, After after);
  // Its subscriptions refer to it.
  TeamInput(const TeamInput&) = delete;
  TeamInput& operator=(const TeamInput&) = delete;

  /// Counts a look of a robot that was of no use.
  void drop(const std::string& robot, const std::string& reason);

 private:
  using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;

  void subscribe(ros::NodeHandle& node, const std::string& robot,
                 diagnostic_updater::Updater& updater);
  void take(const std::string& robot, const BearingArray& message);
  void takePose(const std::string& robot, const PoseMessage& message);

  pipeline::BearingTopics team_;
  pipeline::BearingFeed& feed_;
  After after_;
  std::optional<tf2_ros::TransformListener> listener_;
  std::map<std::string, std::unique_ptr<InputMonitor>> monitors_;
  std::vector<ros::Subscriber> subscribers_;
};

/// Parameters of a node that hears a team. Throws config::Error, also where no robot is named.
template <class Config>
Config readTeamParameters(const ros::NodeHandle& private_node) {
  auto config = readParameters<Config>(private_node);
  if (config.robots.empty()) {
    throw config::Error(private_node.getNamespace(), 0, "robots", "none are named");
  }
  config.map_frame = withoutSlash(config.map_frame);
  return config;
}

}  // namespace sightline::bridge
