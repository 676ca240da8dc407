#pragma once

#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"
#include "sightline/motion/motion_sum.h"
#include "sightline/tracking/beam_points.h"

namespace sightline::tracking {

/// Response of a fitted line to errors of the motion that carries the sensor from beam to beam: the
/// normal equations of the fit, with the points' displacement along the normal on their right-hand
/// side.
class MotionResponse {
 public:
  MotionResponse(const std::vector<const BeamPoint*>& points, const geometry::PolarLine& line);

  /// ∂(ρ, φ) / ∂(twist of the base frame over the sweep, ordered x, y, θ), of which each point
  /// moves by its share of the sweep's time.
  const Eigen::Matrix<double, 2, 3>& jacobian() const { return jacobian_; }
  /// Covariance of (ρ, φ) by what a random walk strays from that share on its way, `walk` being its
  /// covariance at the end of the sweep.
  Eigen::Matrix2d strayCovariance(const Eigen::Matrix3d& walk) const;

 private:
  Eigen::Matrix<double, 2, 3> jacobian_;
  motion::MotionSum<2> sum_;
};

}  // namespace sightline::tracking
