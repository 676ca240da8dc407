#include <map>
#include <memory>
#include <string>
#include <vector>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <sightline/TargetArray.h>
#include "nodes/search_config.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/search_messages.h"
#include "sightline/bridge/team_input.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/time.h"
#include "sightline/pipeline/searching_team.h"

namespace sightline::nodes {

namespace {

pipeline::SearchingTeam makeTeam(const SearchNodeConfig& config) {
  const auto models = config.models.empty() ? targets::SensorModelsConfig{}
                                            : targets::SensorModelsConfig::readFile(config.models);
  auto sight = targets::worldSight(config.world, config.sensor_height);
  return {targets::Search(config.search, models, sight), config.search, config.max_gone};
}

/// Where the robots of a team look for targets next.
class SearchNode {
 public:
  SearchNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(bridge::readTeamParameters<SearchNodeConfig>(private_node)),
        diagnostics_(node, private_node),
        feed_(config_, transforms_),
        team_(makeTeam(config_)),
        markers_(node.advertise<visualization_msgs::MarkerArray>("search_markers", 5)),
        targets_(node.subscribe("targets", 10, &SearchNode::takeTargets, this)),
        input_(node, config_, diagnostics_.updater(), buffer_, feed_, [] {}) {
    for (const std::string& robot : config_.robots) advertise(node, robot);
    diagnostics_.updater().add("search", this, &SearchNode::report);
    timer_ = node.createSteadyTimer(ros::WallDuration(1.0 / config_.rate),
                                    [this](const ros::SteadyTimerEvent&) { run(); });
  }

 private:
  struct Robot {
    ros::Publisher action;
    ros::Publisher command;  // where it is driven
  };

  void advertise(ros::NodeHandle& node, const std::string& name) {
    Robot& robot = robots_[name];
    robot.action = node.advertise<nav_msgs::Path>(config_.topicOf(name, "action"), 5, true);
    if (!config_.drive) return;
    robot.command = node.advertise<geometry_msgs::Twist>(config_.topicOf(name, "cmd_vel"), 5);
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
        input_.drop(look.robot, look.fault);
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
  bridge::TfTransforms transforms_{buffer_};
  bridge::NodeDiagnostics diagnostics_;
  pipeline::BearingFeed feed_;
  pipeline::SearchingTeam team_;
  std::map<std::string, Robot> robots_;
  ros::Publisher markers_;
  ros::Subscriber targets_;
  bridge::TeamInput input_;
  ros::SteadyTimer timer_;
  std::int64_t now_ = 0;
};

}  // namespace

std::shared_ptr<void> makeSearch(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<SearchNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
