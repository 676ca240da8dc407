#pragma once

#include <cstdint>

#include <ros/time.h>

namespace sightline::bridge {

inline std::int64_t nanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}

/// Times before 1970 do not exist in ROS; they become zero.
inline ros::Time timeOf(std::int64_t nanoseconds) {
  ros::Time time;
  if (nanoseconds > 0) time.fromNSec(static_cast<std::uint64_t>(nanoseconds));
  return time;
}

}  // namespace sightline::bridge
