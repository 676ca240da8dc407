#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sightline/motion/head_command.h"

namespace sightline::gaze {

/// Watches whether a head does what it is told.
class HeadWatch {
 public:
  /// `answer` [s]: a head that says nothing, or has not moved towards where it was sent, for so
  /// long is at fault.
  HeadWatch(const motion::HeadLimits& limits, double answer);

  /// The head was sent to a position [rad] at a time [ns].
  void command(double position, std::int64_t now);
  /// The head is at an angle [rad], by a report that came at a time [ns].
  void report(double angle, std::int64_t now);
  /// What is wrong with the head; empty where nothing is.
  std::string fault(std::int64_t now) const;
  /// Whether it was commanded and has not reported since for too long.
  bool isSilent(std::int64_t now) const;
  /// Starts to watch anew: the clock was set, or somebody tries again.
  void restart(std::int64_t now);

  std::optional<double> angle() const { return angle_; }  ///< [rad], last reported

 private:
  bool hasArrived() const;

  double step_;          // of the head's drive [rad]
  std::int64_t answer_;  // [ns]
  std::optional<double> target_;
  std::optional<double> angle_;
  double moved_from_ = 0.0;    // where it was when it was last seen to move [rad]
  std::int64_t moved_at_ = 0;  // when, or when it last had no reason to [ns]
  std::int64_t reported_at_ = 0;
};

}  // namespace sightline::gaze
