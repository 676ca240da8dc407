#pragma once

#include <memory>
#include <string>

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"
#include "sightline/scan/noise_model.h"
#include "sightline/scan/scan_geometry.h"

namespace sightline::simulation {

/// A kind of time-of-flight scanner. Defaults are those of a Hokuyo UTM-30LX.
struct ScannerProfile {
  int beams = 1081;
  double angle_min = geometry::radians(-135.0);  ///< of the first beam [rad]
  double angle_max = geometry::radians(135.0);   ///< of the last beam [rad]
  double range_min = 0.1;                        ///< [m]
  double range_max = 30.0;                       ///< [m]
  double rate = 40.0;                            ///< sweeps a second [Hz]
  double revolution = 0.025;  ///< of the mirror [s]: beams are so far apart in time; 0: all at once
  double resolution = 0.001;  ///< of the reported range [m]; 0: as computed
  double dropout = 0.0;       ///< share of the beams that give no answer, [0, 1]
  double intensity = 0.0;     ///< of a white surface nearby, facing the sensor; 0: none reported
  double intensity_half_range = 10.0;  ///< where half of it comes back [m]
  scan::NoiseModel noise;

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error with file, line where one is to blame, and key.
  static ScannerProfile readFile(const std::string& path);

  /// Throws config::Error naming `source` where a value is out of range or two do not fit.
  void check(const std::string& source) const;
  std::shared_ptr<const scan::ScanGeometry> geometry() const;
  /// Time from the first beam to the last [s].
  double sweepDuration() const;
};

}  // namespace sightline::simulation
