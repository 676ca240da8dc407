#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <sightline/TargetArray.h>
#include "nodes/search_config.h"
#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/search_messages.h"
#include "sightline/bridge/searching_team.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/time.h"
#include "sightline/pipeline/bearing_feed.h"

namespace sightline::nodes {

namespace {

SearchNodeConfig readSearchConfig(const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<SearchNodeConfig>(private_node);
  if (config.robots.empty()) {
    throw config::Error(private_node.getNamespace(), 0, "robots", "none are named");
  }
  config.map_frame = bridge::withoutSlash(config.map_frame);
  return config;
}

bridge::SearchingTeam makeTeam(const SearchNodeConfig& config) {
  const auto models = config.models.empty() ? targets::SensorModelsConfig{}
                                            : targets::SensorModelsConfig::readFile(config.models);
  auto sight = targets::worldSight(config.world, config.sensor_height);
  return {targets::Search(config.search, models, sight), config.search, config.max_gone};
}

/// Where the robots of a team look for targets next.
class SearchNode {
 public:
  SearchNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(readSearchConfig(private_node)),
        diagnostics_(node, private_node),
        feed_(config_.feed(), transforms_),
        team_(makeTeam(config_)),
        markers_(node.advertise<visualization_msgs::MarkerArray>("search_markers", 5)),
        targets_(node.subscribe("targets", 10, &SearchNode::takeTargets, this)) {
    if (config_.pose_topic.empty()) listener_.emplace(buffer_, node);
    for (const std::string& robot : config_.robots) connect(node, robot);
    diagnostics_.updater().add("search", this, &SearchNode::report);
    timer_ = node.createSteadyTimer(ros::WallDuration(1.0 / config_.rate),
                                    [this](const ros::SteadyTimerEvent&) { run(); });
  }

 private:
  using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;

  struct Robot {
    std::unique_ptr<bridge::InputMonitor> monitor;
    ros::Subscriber bearings;
    ros::Subscriber poses;
    ros::Publisher action;
    ros::Publisher command;
  };

  void connect(ros::NodeHandle& node, const std::string& name) {
    constexpr std::uint32_t kQueue = 100;
    const auto topics = config_.feed();
    const std::string topic = topics.topicOf(name, config_.bearings_topic);
    Robot& robot = robots_[name];
    robot.monitor = std::make_unique<bridge::InputMonitor>(topic, diagnostics_.updater());
    robot.action = node.advertise<nav_msgs::Path>(topics.topicOf(name, "action"), 5, true);
    if (config_.drive) {
      robot.command = node.advertise<geometry_msgs::Twist>(topics.topicOf(name, "cmd_vel"), 5);
    }
    robot.bearings = node.subscribe<BearingArray>(
        topic, kQueue,
        [this, name](const BearingArray::ConstPtr& message) { take(name, *message); });
    if (config_.pose_topic.empty()) return;
    robot.poses = node.subscribe<PoseMessage>(
        topics.topicOf(name, config_.pose_topic), kQueue,
        [this, name](const PoseMessage::ConstPtr& message) { takePose(name, *message); });
  }

  void take(const std::string& robot, const BearingArray& message) {
    robots_.at(robot).monitor->use([&] {
      feed_.add({robot, bridge::withoutSlash(message.header.frame_id),
                 bridge::toBearingSet(message), bridge::nanoseconds(ros::Time::now())});
    });
  }

  void takePose(const std::string& robot, const PoseMessage& message) {
    try {
      feed_.addPose(robot, bridge::nanoseconds(message.header.stamp),
                    bridge::toUncertainPose2(message));
    } catch (const bridge::BadMessage& fault) {
      robots_.at(robot).monitor->drop(std::string("pose: ") + fault.what());
    }
  }

  void takeTargets(const TargetArray& message) {
    std::vector<targets::Target> known;
    for (const sightline::Target& target : message.targets) {
      targets::Target one;
      one.mean = {target.position.x, target.position.y};
      one.probability = target.probability;
      known.push_back(one);
    }
    team_.search().setTargets(std::move(known));
  }

  void run() {
    const std::int64_t now = bridge::nanoseconds(ros::Time::now());
    if (now < now_) {  // the clock was set back
      feed_.clear();
      team_.reset();
    }
    now_ = now;
    for (const auto& look : feed_.ready(now)) {
      if (look.fault.empty()) {
        team_.look(look.robot, look.set);
      } else {
        robots_.at(look.robot).monitor->drop(look.fault);
      }
    }
    publish(team_.plan(now), now);
  }

  void publish(const std::vector<std::string>& changed, std::int64_t now) {
    for (const std::string& robot : changed) {
      robots_.at(robot).action.publish(
          bridge::toMessage(team_.actionOf(robot), now, config_.map_frame));
    }
    if (!changed.empty() && markers_.getNumSubscribers() > 0) {
      markers_.publish(bridge::toMarkers(team_.actions(), now, config_.map_frame));
    }
    if (!config_.drive) return;
    for (const auto& [name, robot] : robots_) {
      const simulation::Velocity velocity = team_.steer(name, now);
      geometry_msgs::Twist command;
      command.linear.x = velocity.linear;
      command.angular.z = velocity.angular;
      robot.command.publish(command);
    }
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const std::size_t present = team_.present(now_);
    status.summary(present > 0 ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   present > 0 ? "searching" : "no robot with a pose");
    status.add("robots", present);
    status.add("targets to be found", team_.search().expectedUndetected());
  }

  SearchNodeConfig config_;
  tf2_ros::Buffer buffer_;
  std::optional<tf2_ros::TransformListener> listener_;
  bridge::TfTransforms transforms_{buffer_};
  bridge::NodeDiagnostics diagnostics_;
  pipeline::BearingFeed feed_;
  bridge::SearchingTeam team_;
  std::map<std::string, Robot> robots_;
  ros::Publisher markers_;
  ros::Subscriber targets_;
  ros::SteadyTimer timer_;
  std::int64_t now_ = 0;
};

}  // namespace

std::shared_ptr<void> makeSearch(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<SearchNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
