#include "sightline/bridge/run_clock.h"

#include <algorithm>
#include <cmath>

#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>

#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

// A run that leads starts here, so that nodes may look back by some seconds without reaching zero.
constexpr std::int64_t kFirstStamp = 1000'000'000'000;
constexpr std::int64_t kClockPeriod = 10'000'000;
constexpr double kLongestPause = 0.05;         // s of real time that a leading run makes up for
constexpr std::int64_t kJump = 2'000'000'000;  // ns that a clock which is followed may leap

}  // namespace

RunClock::RunClock(ros::NodeHandle node, double speed_factor)
    : start_(kFirstStamp),
      speed_factor_(speed_factor),
      publisher_(node.advertise<rosgraph_msgs::Clock>("/clock", 10)) {}

std::int64_t RunClock::due(std::int64_t run_time) {
  return publisher_ ? dueLeading() : dueFollowing(run_time);
}

std::int64_t RunClock::dueLeading() {
  const auto now = ros::WallTime::now();
  const double pause = last_call_.isZero() ? 0.0 : (now - last_call_).toSec();
  last_call_ = now;
  due_ += std::llround(1e9 * speed_factor_ * std::clamp(pause, 0.0, kLongestPause));
  return due_;
}

std::int64_t RunClock::dueFollowing(std::int64_t run_time) {
  const std::int64_t now = nanoseconds(ros::Time::now());
  if (now == 0) return run_time;
  const std::int64_t ahead = now - stampOf(run_time);
  if (start_ != 0 && std::abs(ahead) > kJump) {
    ROS_WARN("the clock jumped by %.1f s: the simulation goes on from where it is",
             1e-9 * static_cast<double>(ahead));
    start_ = 0;
  }
  if (start_ == 0) start_ = now - run_time;
  return now - start_;
}

void RunClock::publish(std::int64_t run_time) {
  if (!publisher_ || run_time % kClockPeriod != 0) return;
  rosgraph_msgs::Clock message;
  message.clock = timeOf(stampOf(run_time));
  publisher_.publish(message);
}

}  // namespace sightline::bridge
