#pragma once

#include <chrono>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include "sightline/bridge/log_throttle.h"

namespace sightline::bridge {

/// Publishes the diagnostics of a node once a second of real time, whatever the time of ROS does:
/// it may not have begun, stand still, or be set back. Where simulated time is asked for, its clock
/// is watched, too.
class NodeDiagnostics {
 public:
  NodeDiagnostics(ros::NodeHandle node, ros::NodeHandle private_node);

  diagnostic_updater::Updater& updater() { return updater_; }

 private:
  using Clock = std::chrono::steady_clock;

  void update();
  void watchClock();
  void reportClock(diagnostic_updater::DiagnosticStatusWrapper& status);

  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
  LogThrottle missing_clock_;
  ros::Time time_;                          // of ROS, at the last look
  Clock::time_point moved_ = Clock::now();  // when it was last seen to change
};

}  // namespace sightline::bridge
