#pragma once

#include <string>

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"

namespace sightline::motion {

/// Command to the servo of the sensor head; it holds until the next one.
struct HeadCommand {
  enum class Mode { kPosition, kRate, kStop };
  Mode mode = Mode::kStop;
  double position = 0.0;  ///< kPosition: of the joint [rad]
  double rate = 0.0;      ///< kRate: [rad/s], counter-clockwise; kPosition: at most so fast, 0: as
                          ///< fast as the servo can
};

/// Limits of the servo (pears table 1): 90 degrees in 0.5 s.
struct HeadLimits {
  double lower = geometry::radians(-90.0);      ///< of the joint [rad]
  double upper = geometry::radians(90.0);       ///< [rad]
  double max_rate = 4.5;                        ///< [rad/s]
  double acceleration = 30.0;                   ///< [rad/s²]
  double resolution = geometry::radians(0.36);  ///< of commanded and reported positions [rad]

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where a value is out of range or two do not fit.
  void check(const std::string& source) const;

  /// The nearest position that the servo can be sent to [rad]: a step within the limits.
  double rounded(double position) const;
  /// Reason why the command cannot be followed: not finite, beyond the limits; empty where it can.
  std::string fault(const HeadCommand& command) const;
};

}  // namespace sightline::motion
