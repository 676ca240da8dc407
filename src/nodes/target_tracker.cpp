#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/transform_listener.h>

#include "nodes/target_tracker_config.h"
#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/target_output.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"

namespace sightline::nodes {

namespace {

TargetTrackerNodeConfig readTargetTrackerConfig(const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<TargetTrackerNodeConfig>(private_node);
  if (config.robots.empty()) {
    throw config::Error(private_node.getNamespace(), 0, "robots", "none are named");
  }
  config.map_frame = bridge::withoutSlash(config.map_frame);
  return config;
}

/// Targets by the bearings of a team, whose robots come and go.
class TargetTrackerNode {
 public:
  TargetTrackerNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(readTargetTrackerConfig(private_node)),
        diagnostics_(node, private_node),
        output_(node),
        targets_(output_, config_, transforms_) {
    if (config_.pose_topic.empty()) listener_.emplace(buffer_, node);
    for (const std::string& robot : config_.robots) subscribe(node, robot);
    reset_ = private_node.advertiseService("reset", &TargetTrackerNode::reset, this);
    // Looks whose pose never comes are given up by this clock.
    timer_ = node.createSteadyTimer(ros::WallDuration(0.05),
                                    [this](const ros::SteadyTimerEvent&) { run(); });
  }

 private:
  using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;

  void subscribe(ros::NodeHandle& node, const std::string& robot) {
    constexpr std::uint32_t kQueue = 100;
    const std::string topic = config_.topicOf(robot, config_.bearings_topic);
    monitors_.emplace(robot, std::make_unique<bridge::InputMonitor>(topic, diagnostics_.updater()));
    subscribers_.push_back(node.subscribe<BearingArray>(
        topic, kQueue,
        [this, robot](const BearingArray::ConstPtr& message) { take(robot, *message); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
    if (config_.pose_topic.empty()) return;
    subscribers_.push_back(node.subscribe<PoseMessage>(
        config_.topicOf(robot, config_.pose_topic), kQueue,
        [this, robot](const PoseMessage::ConstPtr& message) { takePose(robot, *message); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }

  void take(const std::string& robot, const BearingArray& message) {
    monitors_.at(robot)->use([&] {
      targets_.feed().add({robot, bridge::withoutSlash(message.header.frame_id),
                           bridge::toBearingSet(message), bridge::nanoseconds(ros::Time::now())});
    });
    run();
  }

  void takePose(const std::string& robot, const PoseMessage& message) {
    try {
      targets_.feed().addPose(robot, bridge::nanoseconds(message.header.stamp),
                              bridge::toUncertainPose2(message));
    } catch (const bridge::BadMessage& fault) {
      monitors_.at(robot)->drop(std::string("pose: ") + fault.what());
    }
    run();
  }

  void run() {
    const std::int64_t now = bridge::nanoseconds(ros::Time::now());
    if (now < now_) targets_.reset();  // the clock was set back
    now_ = now;
    for (const auto& [robot, reason] : targets_.run(now)) monitors_.at(robot)->drop(reason);
  }

  bool reset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
    targets_.reset();
    return true;
  }

  TargetTrackerNodeConfig config_;
  tf2_ros::Buffer buffer_;
  std::optional<tf2_ros::TransformListener> listener_;
  bridge::TfTransforms transforms_{buffer_};
  bridge::NodeDiagnostics diagnostics_;
  bridge::Output output_;
  bridge::TargetOutput targets_;
  std::map<std::string, std::unique_ptr<bridge::InputMonitor>> monitors_;
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceServer reset_;
  ros::SteadyTimer timer_;
  std::int64_t now_ = 0;
};

}  // namespace

std::shared_ptr<void> makeTargetTracker(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<TargetTrackerNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
