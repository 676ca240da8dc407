#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/config/node.h"
#include "sightline/triangulation/calibration_table.h"
#include "sightline/triangulation/intrinsics.h"
#include "sightline/triangulation/scan_pattern.h"

namespace sightline::triangulation {

/// Place of the scan on the head. The projection frame is parallel to the sensor frame, which turns
/// with the head about its origin; the projected vergence is added to every scan angle.
struct ScanOrigin {
  double x = 0.050;                                    ///< [m], ahead of the head's axis
  double y = -0.030;                                   ///< [m], to its left
  double projected_vergence = geometry::radians(1.5);  ///< γᵖ [rad], counter-clockwise

  void visit(config::FieldVisitor& visitor);
  Eigen::Vector2d position() const { return {x, y}; }
};

/// Constants of a sensor.
struct SensorParameters {
  std::string serial = "SS-0001";
  ScanPattern scan;
  Intrinsics intrinsics;
  ScanOrigin origin;
  double noise_current = 36.22e-12;  ///< I_n of eq. 2 [A]

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source`.
  void check(const std::string& source) const;
};

/// Outcome of both calibration phases for one sensor (pears section 3.2).
///
/// ```yaml
/// sensor: SS-0001                       # serial number
/// scan: {beams: 256, ...}               # ScanPattern
/// intrinsics: {focal_length: 0.05, ...} # Intrinsics
/// origin: {x: 0.04, ...}                # ScanOrigin
/// noise_current: 3.62e-11               # A
/// standard_deviations: {...}            # of what was estimated; for people
/// table: {depths: [...], image_positions: [[...], ...]}   # m
/// ```
struct Calibration {
  SensorParameters parameters;
  CalibrationTable table;

  /// Throws config::Error with file, line and key: also where the table has another number of
  /// beams than the scan.
  static Calibration readFile(const std::string& path);
  static Calibration read(const config::Node& document);

  /// Throws config::Error if this is the calibration of another sensor than `serial`.
  void requireSensor(const std::string& serial, const std::string& source) const;
};

/// The table that a sensor with exactly these parameters fills: for want of a measured one. Targets
/// at depths [m] of the sensor frame; those beyond the detector are left out.
CalibrationTable modelledTable(const SensorParameters& parameters,
                               const std::vector<double>& depths);

/// `count` ≥ 2 depths [m], equally far apart on the detector: uniform in 1/z.
std::vector<double> tableDepths(double nearest, double farthest, std::size_t count);

}  // namespace sightline::triangulation
