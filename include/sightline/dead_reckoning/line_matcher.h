#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/submap.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Distance of a point of the base from the line of a surfel [m], and its derivative by the
/// coordinates (x, y, θ) of the pose.
struct LineResidual {
  double value = 0.0;
  Eigen::RowVector3d jacobian = Eigen::RowVector3d::Zero();
};
LineResidual lineResidual(const geometry::Pose2& T_odom_base, const Eigen::Vector2d& point_base,
                          const Surfel& surfel);

/// A pose of the base that explains a scan.
struct LineMatch {
  geometry::Pose2 T_odom_base;
  /// Of the coordinates (x, y, θ), from the beams alone: 1/m², 1/m, 1.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double inliers = 0.0;  ///< share of the points
  double cost = 1.0;     ///< mean truncated squared distance, [0, 1]
  bool converged = false;
};

/// What is known of a pose besides the scan.
struct PosePrior {
  geometry::Pose2 T_odom_base;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of its coordinates
};

/// Point-to-line matching by iteratively reweighted least squares: the maximum a posteriori pose
/// under Geman-McClure's loss, whose scale falls from `start_scale` to that of the noise.
LineMatch matchLines(const std::vector<SurfacePoint>& points, const Submap& submap,
                     const geometry::Pose2& start, const PosePrior& prior, double surface_sigma,
                     double start_scale);

}  // namespace sightline::dead_reckoning
