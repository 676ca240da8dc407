#pragma once

#include <memory>

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"
#include "sightline/scan/scan_geometry.h"

namespace sightline::triangulation {

/// Times and directions of the measurements, and their limits (pears table 1). One scan follows the
/// other without a pause: 256 samples at 2.5 kHz are 9.8 scans a second.
struct ScanPattern {
  int beams = 256;
  double field_of_view = geometry::radians(40.0);  ///< from the first beam to the last [rad]
  double sample_rate = 2500.0;                     ///< [Hz]
  double range_min = 0.4;                          ///< [m], along the beam
  double range_max = 2.5;                          ///< [m]
  double min_current = 0.8e-9;                     ///< [A]; with less there is no measurement
  double bandwidth = 0.0;  ///< of the one pole of the detector [Hz]; 0: none

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where a value is out of range or two do not fit.
  void check(const std::string& source) const;

  /// Scan angle [rad] of a beam: from −field_of_view/2 upwards, counter-clockwise.
  double scanAngle(double beam) const;
  /// Share [0, 1) that a sample keeps of the one before it: exp(−2π bandwidth / sample_rate).
  double memory() const;
  double scanPeriod() const { return beams / sample_rate; }  ///< [s], from scan to scan
  /// The scan in a frame in which every beam is turned by `projected_vergence` [rad].
  std::shared_ptr<const scan::ScanGeometry> geometry(double projected_vergence) const;
};

}  // namespace sightline::triangulation
