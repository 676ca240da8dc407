#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/motion_noise.h"
#include "sightline/scan/scan_geometry.h"

namespace sightline::scan {

/// Kind of answer that a beam came back with (REP-117).
enum class ReturnKind : std::uint8_t {
  kValid,    ///< a range within the limits
  kTooNear,  ///< −Inf, or below range_min: something is there, too close to measure
  kNothing,  ///< +Inf, or beyond range_max: nothing within reach
  kInvalid,  ///< NaN, zero or negative: no statement
};

/// Sorts a range into its kind by the limits of the geometry (`min <= r && r <= max` is valid).
ReturnKind classify(double range, const ScanGeometry& geometry);

/// One sweep of a planar range sensor: made by all that measures, taken by all
/// that estimates. Each vector holds one entry a beam, always.
class Scan {
 public:
  std::int64_t stamp = 0;  ///< of the first beam [ns]
  std::string frame;
  double angular_variance = 0.0;     ///< of each beam's direction [rad²]
  double transverse_variance = 0.0;  ///< across the beam, whatever the range [m²]
  MotionNoise motion_noise;          ///< of the sensor's motion

  /// No beams and no geometry.
  Scan() = default;
  /// Kinds follow from the ranges; each range has a variance of (0.01 m)² until it is given one.
  ///
  /// @param ranges       [m]
  /// @param intensities  empty where the sensor has none
  /// Throws InvalidScan where the geometry is missing or the lengths are not those of its beams.
  Scan(std::shared_ptr<const ScanGeometry> geometry, std::int64_t stamp, std::vector<double> ranges,
       std::vector<double> intensities = {});

  /// Null where there are no beams.
  const std::shared_ptr<const ScanGeometry>& geometry() const { return geometry_; }
  std::size_t beams() const { return ranges_.size(); }
  const std::vector<double>& ranges() const { return ranges_; }  ///< [m]
  const std::vector<ReturnKind>& kinds() const { return kinds_; }
  const std::vector<double>& intensities() const { return intensities_; }
  /// Along the beam [m²].
  const std::vector<double>& rangeVariances() const { return range_variances_; }
  /// The sensor's pose at each beam, in its own frame at the stamp; empty where it stood still.
  const std::vector<geometry::Pose2>& sensorMotion() const { return sensor_motion_; }

  /// Changes what a beam says; its kind follows from the range.
  void setRange(std::size_t beam, double range);
  /// Changes the kind alone, as where a beam shall not count.
  void setKind(std::size_t beam, ReturnKind kind) { kinds_[beam] = kind; }
  /// The setters of vectors throw InvalidScan where the length is not the number of beams; motion
  /// and intensities may be empty.
  void setRangeVariances(std::vector<double> variances);
  void setSensorMotion(std::vector<geometry::Pose2> motion);
  void setIntensities(std::vector<double> intensities);

  bool isValid(std::size_t beam) const { return kinds_[beam] == ReturnKind::kValid; }
  /// Direction of a beam in the sensor's frame at the stamp.
  Eigen::Vector2d direction(std::size_t beam) const;
  /// End of a valid beam, in the sensor's frame at the stamp [m].
  Eigen::Vector2d point(std::size_t beam) const;
  /// Covariance of point(beam) [m²], first order in the angle; the motion's noise is not in it.
  Eigen::Matrix2d covariance(std::size_t beam) const;
  /// The same where the beam's direction is at hand.
  Eigen::Matrix2d covariance(std::size_t beam, const Eigen::Vector2d& along) const;
  /// Time from the first beam to the last [s].
  double duration() const { return geometry_ ? geometry_->timeOffsets().back() : 0.0; }
  /// Stamp of the last beam [ns].
  std::int64_t end() const;

 private:
  void requireLength(const char* what, std::size_t length) const;

  std::shared_ptr<const ScanGeometry> geometry_;
  std::vector<double> ranges_;
  std::vector<ReturnKind> kinds_;
  std::vector<double> range_variances_;
  std::vector<double> intensities_;
  std::vector<geometry::Pose2> sensor_motion_;
  std::vector<Eigen::Vector2d> directions_;  // as the motion has turned them; empty without one
};

/// The scan as a sensor the right way up at the same place would have taken it, of one that hangs
/// upside down: angles, motion and the motion's noise mirrored at the x axis. `mirrored_geometry`
/// is ScanGeometry::mirrored() of the scan's own, shared between scans.
Scan mirrored(const Scan& scan, std::shared_ptr<const ScanGeometry> mirrored_geometry);

}  // namespace sightline::scan
