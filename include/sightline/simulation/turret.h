#pragma once

#include <cstdint>

#include "sightline/motion/pose_history.h"
#include "sightline/motion/sensor_head.h"

namespace sightline::simulation {

/// A turret that turns as it is told, as the head of an active sensor does, and remembers how it
/// turned. Times are those of the run [ns].
class Turret {
 public:
  /// Stands straight ahead at time 0. Throws config::Error.
  explicit Turret(const motion::HeadLimits& limits);

  /// A command that its limits do not allow is not heard.
  void command(const motion::HeadCommand& command) { head_.command(command); }
  /// Turns on until such a time.
  void turnUntil(std::int64_t time);

  /// Angle at a time within the last ten seconds [rad], counter-clockwise.
  double angleAt(std::int64_t time) const;
  const motion::SensorHead& head() const { return head_; }

 private:
  motion::SensorHead head_;
  motion::PoseHistory turned_;  // angles, as poses at the origin
};

}  // namespace sightline::simulation
