#pragma once

#include <string>

#include "sightline/config/fields.h"
#include "sightline/motion/head_command.h"
#include "sightline/triangulation/calibration.h"

namespace sightline::triangulation {

/// Depths of the table that stands in for a measured one: `count` of them, uniform in 1/z.
struct ModelledDepths {
  double nearest = 0.35;   ///< [m], sensor frame
  double farthest = 2.85;  ///< [m]
  int count = 40;

  void visit(config::FieldVisitor& visitor);
};

/// Properties of a synchronised-scan sensor on its servo head (pears section 2), be it real or
/// simulated. Files of it are in config/sensors.
struct SensorProfile {
  SensorParameters sensor;
  motion::HeadLimits head;
  ModelledDepths modelled_depths;
  std::string calibration;  ///< path of a calibration file; empty: as the parameters say

  void visit(config::FieldVisitor& visitor);
  /// Leaves alone what only a simulated sensor has (keys at the top of the file that no field here
  /// knows). Throws config::Error with file, line where one is to blame, and key.
  static SensorProfile readFile(const std::string& path);
  void check(const std::string& source) const;
  /// Takes the path of the calibration relative to the document, where it names one.
  void resolveCalibration(const config::Node& document);

  /// Calibration that turns its currents into ranges: the calibration file, which has to be of this
  /// sensor and of its scan, and whose limits of range and current count; or, without one, a table
  /// as these very parameters fill it. Throws config::Error.
  Calibration calibrated() const;
};

}  // namespace sightline::triangulation
