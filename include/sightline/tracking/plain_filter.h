#pragma once

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/tracking/line_innovation.h"
#include "sightline/tracking/tracker_config.h"

namespace sightline::tracking {

/// The Kalman filter of jensfelt section 4 as printed: state (x, y, θ), odometry and its noise
/// added to it.
class PlainFilter {
 public:
  explicit PlainFilter(const geometry::UncertainPose2& start) : state_(start) {}

  /// Adds a step of odometry, given in the body frame at its start (eqs 5 and 8): the heading's
  /// uncertainty does not move the position.
  void predict(const PlainConfig& config, const geometry::Pose2& step);
  /// Normalised innovation squared of a wall; the method has no use for it but to report it.
  double nis(const LineInnovation& innovation) const;
  /// Takes a wall in (eq. 9).
  void update(const LineInnovation& innovation);
  /// Adds to the standard deviations of position, along each axis, and heading [m, rad] (section
  /// 4.3).
  void inflate(double position_sigma, double heading_sigma);
  /// Keeps every standard deviation at the floor or above (section 4.3).
  void applyFloor(const PlainConfig& config);

  const geometry::UncertainPose2& pose() const { return state_; }

 private:
  Eigen::Matrix2d covarianceOf(const LineInnovation& innovation) const;

  geometry::UncertainPose2 state_;
};

}  // namespace sightline::tracking
