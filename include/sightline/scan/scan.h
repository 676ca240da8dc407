#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan_geometry.h"

namespace sightline::scan {

/// What a beam came back with (REP-117).
enum class ReturnKind : std::uint8_t {
  kValid,    ///< a range within the limits
  kTooNear,  ///< −Inf, or below range_min: something is there, too close to measure
  kNothing,  ///< +Inf, or beyond range_max: nothing within reach
  kInvalid,  ///< NaN, zero or negative: no statement
};

/// One sweep of a planar range sensor: the type that everything which measures makes, and
/// everything which estimates eats. Vectors hold one entry a beam.
struct Scan {
  std::shared_ptr<const ScanGeometry> geometry;
  std::int64_t stamp = 0;  ///< of the first beam, nanoseconds
  std::string frame;
  std::vector<double> ranges;  ///< [m]; meaningful where the kind is valid
  std::vector<ReturnKind> kinds;
  std::vector<double> range_variances;  ///< [m²], along the beam
  double angular_variance = 0.0;        ///< of each beam's direction [rad²]
  double transverse_variance = 0.0;     ///< across the beam, whatever the range [m²]
  std::vector<double> intensities;      ///< empty where the sensor has none
  /// The sensor's pose at each beam, in its own frame at the stamp; empty when it stood still.
  std::vector<geometry::Pose2> sensor_motion;

  std::size_t beams() const { return ranges.size(); }
  bool isValid(std::size_t beam) const { return kinds[beam] == ReturnKind::kValid; }
  /// Direction of a beam in the sensor's frame at the stamp.
  Eigen::Vector2d direction(std::size_t beam) const;
  /// Where a valid beam ended, in the sensor's frame at the stamp.
  Eigen::Vector2d point(std::size_t beam) const;
  /// Covariance of point(beam) [m²], first order in the angle.
  Eigen::Matrix2d covariance(std::size_t beam) const;
};

/// Sorts a range into its kind by the limits of the geometry (`min <= r && r <= max` is valid).
ReturnKind classify(double range, const ScanGeometry& geometry);

}  // namespace sightline::scan
