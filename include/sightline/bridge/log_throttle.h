#pragma once

#include <chrono>
#include <optional>

namespace sightline::bridge {

/// Lets a log entry through once every 10 s. ROS's own throttle goes by the time of ROS: it is
/// silent as long as that stands still, and after it was set back.
class LogThrottle {
 public:
  bool isDue() {
    const auto now = std::chrono::steady_clock::now();
    if (last_ && now - *last_ < kPeriod) return false;
    last_ = now;
    return true;
  }

 private:
  static constexpr std::chrono::seconds kPeriod{10};
  std::optional<std::chrono::steady_clock::time_point> last_;
};

}  // namespace sightline::bridge
