#pragma once

#include "sightline/motion/head_command.h"

namespace sightline::motion {

/// The servo platform that turns the sensor head: follows commands with limited rate and
/// acceleration, and brakes before its target and before its limits. It comes to rest on a step of
/// its drive, and knows where between two steps it is while it turns (pears section 4.2).
class SensorHead {
 public:
  /// Stands at 0, or at the step within its limits next to it. Throws config::Error.
  explicit SensorHead(const HeadLimits& limits);

  /// Positions are rounded to the servo's steps. A command that limits().fault() names is to be
  /// refused before; here it does nothing.
  void command(const HeadCommand& command);
  /// Moves on by `duration` [s], small against the time that the rate takes to change.
  void step(double duration);

  double angle() const { return angle_; }  ///< [rad]
  double rate() const { return rate_; }    ///< [rad/s]
  const HeadLimits& limits() const { return limits_; }

 private:
  double restingPlace() const;
  double target() const;
  double wantedRate(double duration) const;

  HeadLimits limits_;
  HeadCommand command_;
  double angle_;
  double rate_ = 0.0;
};

}  // namespace sightline::motion
