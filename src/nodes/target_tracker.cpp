#include <memory>

#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>

#include "nodes/target_tracker_config.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/target_output.h"
#include "sightline/bridge/team_input.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/time.h"

namespace sightline::nodes {

namespace {

/// Targets by the bearings of a team, whose robots come and go.
class TargetTrackerNode {
 public:
  TargetTrackerNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(bridge::readTeamParameters<TargetTrackerNodeConfig>(private_node)),
        diagnostics_(node, private_node),
        output_(node),
        targets_(output_, config_, transforms_),
        input_(node, config_, diagnostics_.updater(), buffer_, targets_.feed(), [this] { run(); }) {
    reset_ = private_node.advertiseService("reset", &TargetTrackerNode::reset, this);
    // Looks whose pose never comes are given up by this clock.
    timer_ = node.createSteadyTimer(ros::WallDuration(0.05),
                                    [this](const ros::SteadyTimerEvent&) { run(); });
  }

 private:
  void run() {
    const std::int64_t now = bridge::nanoseconds(ros::Time::now());
    if (now < now_) targets_.reset();  // the clock was set back
    now_ = now;
    for (const auto& [robot, reason] : targets_.run(now)) input_.drop(robot, reason);
  }

  bool reset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
    targets_.reset();
    return true;
  }

  TargetTrackerNodeConfig config_;
  tf2_ros::Buffer buffer_;
  bridge::TfTransforms transforms_{buffer_};
  bridge::NodeDiagnostics diagnostics_;
  bridge::Output output_;
  bridge::TargetOutput targets_;
  bridge::TeamInput input_;
  ros::ServiceServer reset_;
  ros::SteadyTimer timer_;
  std::int64_t now_ = 0;
};

}  // namespace

std::shared_ptr<void> makeTargetTracker(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<TargetTrackerNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
