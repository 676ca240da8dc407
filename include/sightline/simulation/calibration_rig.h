#pragma once

#include <cstdint>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/simulation/optical_head.h"
#include "sightline/triangulation/calibration_recording.h"

namespace sightline::simulation {

/// Targets that are held in front of a sensor to calibrate it.
struct RigConfig {
  double nearest = 0.35;   ///< depth of the nearest plain target [m], sensor frame
  double farthest = 2.85;  ///< of the farthest [m]
  int depths = 40;         ///< of plain targets, equally far apart on the detector
  int readings = 40;       ///< of a target; 4 s at 9.8 scans a second
  double reflectivity = 0.9;
  double stripe_width = 0.05;         ///< [m]
  double stripe_edge = 0.01;          ///< y of one edge [m]
  double dark_reflectivity = 0.1;     ///< of every other stripe; the others are as bright as plain
  std::vector<double> striped_depths  ///< [m]
      {0.40, 0.45, 0.50, 0.55, 0.60, 0.65, 0.70, 0.75, 0.80, 0.85, 0.90, 0.95, 1.00};

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where a value is out of range or two do not fit.
  void check(const std::string& source) const;
};

/// Records what a sensor with these parameters sees in the rig. Noise of the image position is that
/// of pears eq. 2, that of the total current I_n, both of the mean over the readings. Targets whose
/// spot is not wholly on the detector are left out. Throws config::Error.
triangulation::CalibrationRecording recordCalibration(const triangulation::SensorParameters& sensor,
                                                      const Optics& optics, const RigConfig& rig,
                                                      std::uint64_t seed);

}  // namespace sightline::simulation
