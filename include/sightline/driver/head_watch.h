#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sightline/motion/head_command.h"

namespace sightline::driver {

/// Watches whether the head does what it was told: a head that is not where it was sent, or has to
/// turn and may, and has stood still for a second, does not follow.
class HeadWatch {
 public:
  explicit HeadWatch(const motion::HeadLimits& limits = {}) : limits_(limits) {}

  /// Times are steady [ns].
  void command(const motion::HeadCommand& command, std::int64_t now);
  void observe(const std::vector<double>& head_angles, std::int64_t now);

  /// `does not follow: at A rad, sent to B rad`; empty while it does.
  const std::string& fault() const { return fault_; }

 private:
  bool shallMove() const;
  std::string describe() const;

  motion::HeadLimits limits_;
  std::optional<motion::HeadCommand> command_;
  std::int64_t moved_ = 0;  // when it was last seen elsewhere, or told something new
  double angle_ = 0.0;      // then [rad]
  std::string fault_;
};

}  // namespace sightline::driver
