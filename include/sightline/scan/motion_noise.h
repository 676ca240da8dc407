#pragma once

#include <Eigen/Core>

namespace sightline::scan {

/// Noise of the sensor's motion from the first beam of a sweep to the others (pears eqs 14, 21, 23
/// and 24, for any planar motion). All zero where the motion is known exactly or the sensor stood
/// still.
///
/// Covariances are of the coordinates (x, y, θ) [m², m rad, rad²] of the sensor's frame at the last
/// beam in its frame at the stamp.
struct MotionNoise {
  /// A velocity that is wrong by the same amount throughout: the error grows with the time since
  /// the first beam.
  Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();
  /// Independent errors of each stretch of time that add up (pears eq. 14): the variance grows with
  /// the time since the first beam.
  Eigen::Matrix3d walk = Eigen::Matrix3d::Zero();
  /// Variance of a heading error that each beam draws anew, as by the steps of a head's encoder
  /// [rad²].
  double jitter = 0.0;
  /// Axis about which the jitter turns the sensor, in its frame at the stamp [m].
  Eigen::Vector2d jitter_axis = Eigen::Vector2d::Zero();

  bool isZero() const { return drift.isZero(0.0) && walk.isZero(0.0) && jitter == 0.0; }
};

}  // namespace sightline::scan
