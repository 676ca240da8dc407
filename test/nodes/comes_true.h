#pragma once

#include <functional>

#include <ros/ros.h>

namespace sightline::test {

/// Whether a condition comes to hold within a minute; `attempt` is made before it is looked at
/// again, every 50 ms, for what may be lost on its way as long as not everybody is connected.
inline bool comesTrue(const std::function<bool()>& condition,
                      const std::function<void()>& attempt = {}) {
  constexpr int kAttempts = 1200;
  constexpr int kLooks = 5;
  for (int i = 0; i < kLooks * kAttempts && ros::ok(); ++i) {
    if (condition()) return true;
    if (attempt && i % kLooks == 0) attempt();
    ros::WallDuration(0.01).sleep();
  }
  return condition();
}

}  // namespace sightline::test
