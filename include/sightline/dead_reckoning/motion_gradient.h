#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Effect of the noise of the sensor's motion within a sweep on the least squares that match the
/// sweep.
///
/// A pose is found by δ = −(Aᵀ W A)⁻¹ Aᵀ W s, with s the residuals. Where the sensor's pose at the
/// time of beam i errs by e(tᵢ) = (x, y, θ), point i is displaced across its surface by hᵢᵀ e(tᵢ),
/// so that the gradient Aᵀ W s errs by the sum of aᵢ wᵢ hᵢᵀ e(tᵢ): errors that all beams of a
/// sweep share and that no number of beams averages away. With t the share of the sweep's time
/// that has passed, a drift is e(t) = t d and a walk has the covariance W min(t, t').
class MotionGradient {
 public:
  /// @param T_odom_base  pose that the surfaces are matched at
  MotionGradient(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base);

  /// Adds a residual of a point.
  /// @param normal_odom        of the surface that the point is measured across, unit
  /// @param weighted_jacobian  aᵢ wᵢ
  void add(std::size_t point, const Eigen::Vector2d& normal_odom,
           const Eigen::Vector3d& weighted_jacobian);

  /// Covariance of the gradient's error; zero where the motion is known exactly.
  Eigen::Matrix3d covariance() const;

 private:
  struct Term {
    double time = 0.0;                                   // share of the sweep, [0, 1]
    Eigen::Matrix3d by_error = Eigen::Matrix3d::Zero();  // aᵢ wᵢ hᵢᵀ, axes of odom
  };
  Eigen::Matrix3d drift() const;
  Eigen::Matrix3d walk() const;

  const SurfaceScan& surfaces_;
  Eigen::Matrix2d R_odom_base_;
  std::vector<Term> terms_;
};

/// Information on the coordinates of a pose that the points of a scan give, each across its own
/// surface, with `sigma` [m] of error each.
Eigen::Matrix3d surfaceInformation(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base,
                                   double sigma);

/// Covariance of what the motion's noise adds to the gradient that belongs to surfaceInformation.
Eigen::Matrix3d surfaceMotionGradient(const SurfaceScan& surfaces,
                                      const geometry::Pose2& T_odom_base, double sigma);

/// Covariance of the pose's error that the motion's noise makes where nothing but the scan's own
/// surfaces tells the pose. Zero where the motion is known exactly.
Eigen::Matrix3d motionDisplacement(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base);

}  // namespace sightline::dead_reckoning
