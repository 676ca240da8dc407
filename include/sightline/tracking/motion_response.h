#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"
#include "sightline/motion/motion_sum.h"
#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/sweep_error.h"

namespace sightline::tracking {

/// Response of a fitted line to errors of the motion that carries the sensor from beam to beam: the
/// normal equations of the fit, with the points' displacement along the normal on their right-hand
/// side.
class MotionResponse {
 public:
  MotionResponse(const std::vector<const BeamPoint*>& points, const geometry::PolarLine& line);

  const LineBySweepError& jacobian() const { return jacobian_; }
  /// Covariance of (ρ, φ) by what a random walk strays from the straight way between two knots,
  /// `walk` being its covariance at the end of the sweep.
  Eigen::Matrix2d strayCovariance(const Eigen::Matrix3d& walk) const;

 private:
  void add(double sweep_ratio, const Eigen::Matrix<double, 2, 3>& response);

  LineBySweepError jacobian_ = LineBySweepError::Zero();
  std::array<motion::MotionSum<2>, kKnots> between_;  // the start or a knot, and the next
};

}  // namespace sightline::tracking
