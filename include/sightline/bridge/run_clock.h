#pragma once

#include <cstdint>
#include <optional>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

namespace sightline::bridge {

/// Ties the time of a simulated run, nanoseconds from its start, to the time of ROS. It either
/// follows ROS, or is the clock of all nodes and publishes /clock.
class RunClock {
 public:
  /// Follows ros::Time, from the first call of due() on that finds it running. Where it jumps, the
  /// run goes on from where it is.
  RunClock() = default;
  /// Leads: `speed_factor` simulated seconds to one real second, fewer when the machine cannot keep
  /// up.
  RunClock(ros::NodeHandle node, double speed_factor);

  /// Time that the run, now at `run_time`, should have reached.
  std::int64_t due(std::int64_t run_time);
  /// Time in ROS of a moment of the run [ns].
  std::int64_t stampOf(std::int64_t run_time) const { return start_ + run_time; }
  /// Publishes the time of the run; call it as the run moves on, before anything of that time is
  /// published.
  void publish(std::int64_t run_time);

 private:
  std::int64_t dueLeading();
  std::int64_t dueFollowing(std::int64_t run_time);

  std::int64_t start_ = 0;  // stamp of run time 0; 0 as long as ROS has no time
  double speed_factor_ = 0.0;
  std::int64_t due_ = 0;  // of a leading run
  ros::Publisher publisher_;
  ros::WallTime last_call_;
};

}  // namespace sightline::bridge
