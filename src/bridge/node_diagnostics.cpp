#include "sightline/bridge/node_diagnostics.h"

#include <ros/console.h>

namespace sightline::bridge {

namespace {

const ros::WallDuration kPeriod(1.0);
// Time without a clock, or for which it stands still, that is told of.
constexpr std::chrono::seconds kLongestWait{3};
constexpr const char* kMissing =
    "use_sim_time is set, and nobody publishes /clock: rosbag play --clock does, or "
    "rosparam set use_sim_time false";

}  // namespace

NodeDiagnostics::NodeDiagnostics(ros::NodeHandle node, ros::NodeHandle private_node)
    : updater_(node, private_node) {
  updater_.setHardwareID("none");
  if (ros::Time::isSimTime()) updater_.add("clock", this, &NodeDiagnostics::reportClock);
  timer_ = node.createSteadyTimer(kPeriod, [this](const ros::SteadyTimerEvent&) { update(); });
}

// update() of the updater would wait for the time of ROS to go on.
void NodeDiagnostics::update() {
  if (ros::Time::isSimTime()) watchClock();
  updater_.force_update();
}

void NodeDiagnostics::watchClock() {
  const ros::Time now = ros::Time::now();
  if (now != time_) moved_ = Clock::now();
  time_ = now;
  const bool is_missing = now.isZero() && Clock::now() - moved_ > kLongestWait;
  if (is_missing && missing_clock_.isDue()) ROS_WARN("%s", kMissing);
}

void NodeDiagnostics::reportClock(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (Clock::now() - moved_ <= kLongestWait) {
    status.summary(DiagnosticStatus::OK, "simulated time goes on");
  } else if (time_.isZero()) {
    status.summary(DiagnosticStatus::ERROR, kMissing);
  } else {
    status.summary(DiagnosticStatus::WARN, "simulated time stands still");
  }
}

}  // namespace sightline::bridge
