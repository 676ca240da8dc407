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
  /// @param walk  covariance of the random walk of the motion at the end of the sweep
  MotionResponse(const std::vector<const BeamPoint*>& points, const geometry::PolarLine& line,
                 const Eigen::Matrix3d& walk);

  const LineBySweepError& jacobian() const { return jacobian_; }
  /// Covariance of (ρ, φ) by what the walk strays from the straight way between two knots.
  const Eigen::Matrix2d& strayCovariance() const { return stray_covariance_; }

 private:
  using Sums =
      std::array<motion::MotionSum<2>, kKnots>;  // between the start or a knot and the next

  void add(double sweep_ratio, const Eigen::Matrix<double, 2, 3>& response, Sums* sums);

  LineBySweepError jacobian_ = LineBySweepError::Zero();
  Eigen::Matrix2d stray_covariance_ = Eigen::Matrix2d::Zero();
};

}  // namespace sightline::tracking
