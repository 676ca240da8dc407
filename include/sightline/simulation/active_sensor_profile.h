#pragma once

#include <string>

#include "sightline/config/fields.h"
#include "sightline/driver/head_joint.h"
#include "sightline/motion/head_command.h"
#include "sightline/simulation/calibration_rig.h"
#include "sightline/simulation/optical_head.h"
#include "sightline/triangulation/calibration.h"

namespace sightline::simulation {

/// A synchronised-scan sensor on its servo head (pears section 2): what there is to know of the
/// real one, and of the light in it for a simulated one. Files of it are in config/sensors.
struct ActiveSensorProfile {
  triangulation::SensorParameters sensor;
  motion::HeadLimits head;
  Optics optics;
  double bandwidth = 0.0;   ///< of the detector [Hz]; 0: none (pears eq. 2 has none)
  RigConfig rig;            ///< for calibrate_sensor
  std::string calibration;  ///< path of a calibration file; empty: as the parameters say

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error with file, line where one is to blame, and key.
  static ActiveSensorProfile readFile(const std::string& path);
  void check(const std::string& source) const;

  /// Takes the limits of the head from a robot description; the rest stays. Throws config::Error
  /// naming `source` where that puts the scan's origin elsewhere.
  void takeHead(const driver::HeadJoint& joint, const std::string& source);

  /// What turns its currents into ranges: the calibration file, which has to be of this sensor and
  /// of its scan, and whose limits of range and current count; or, without one, a table as these
  /// very parameters fill it. Throws config::Error.
  triangulation::Calibration calibrated() const;
};

}  // namespace sightline::simulation
