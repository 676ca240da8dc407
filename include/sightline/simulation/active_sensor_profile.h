#pragma once

#include <string>

#include "sightline/config/fields.h"
#include "sightline/driver/head_joint.h"
#include "sightline/simulation/calibration_rig.h"
#include "sightline/simulation/optical_head.h"
#include "sightline/triangulation/sensor_profile.h"

namespace sightline::simulation {

/// A synchronised-scan sensor as it is known, and what is true of a simulated one besides.
struct ActiveSensorProfile : triangulation::SensorProfile {
  Optics optics;
  double bandwidth = 0.0;  ///< of the detector [Hz]; 0: none (pears eq. 2 has none)
  double jitter = 0.0;     ///< of the true head angle about the reported one [rad], pears eq. 23
  RigConfig rig;           ///< for calibrate_sensor

  // Written out, as GCC 12 warns of an aggregate's base that it were not initialised.
  ActiveSensorProfile() {}

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error with file, line where one is to blame, and key.
  static ActiveSensorProfile readFile(const std::string& path);
  void check(const std::string& source) const;

  /// Takes the limits of the head from a robot description; the rest stays. Throws config::Error
  /// naming `source` where that puts the scan's origin elsewhere.
  void takeHead(const driver::HeadJoint& joint, const std::string& source);
};

}  // namespace sightline::simulation
