#pragma once

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
  Eigen::Vector3d jacobian = Eigen::Vector3d::Zero();
};

/// @param arm_odom  the point, seen from the base, along the axes of odom [m]
LineResidual lineResidual(const Eigen::Vector2d& translation_odom, const Eigen::Vector2d& arm_odom,
                          const Surfel& surfel);

/// A pose of the base at which a scan meets the reference.
struct LineMatch {
  geometry::Pose2 T_odom_base;
  /// Of the coordinates (x, y, θ), by the beams alone and as if their errors were independent.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Of each point from its counterpart's line, in standard deviations; NaN without a counterpart.
  std::vector<double> residuals;
  std::vector<double> distances;  ///< the same in metres
};

/// Point-to-line matching by iteratively reweighted least squares: the maximum a posteriori pose
/// under Geman-McClure's loss.
class LineMatcher {
 public:
  /// @param surface_sigma  roughness of surfaces and errors of the reference [m]
  explicit LineMatcher(double surface_sigma) : surface_variance_(surface_sigma * surface_sigma) {}

  /// @param start_scale  scale of the loss at first; it falls to that of the noise [m]
  LineMatch match(const std::vector<SurfacePoint>& points, const Submap& submap,
                  const geometry::Pose2& start, const geometry::UncertainPose2& prior,
                  double start_scale);

 private:
  struct Pair {
    const SurfacePoint* point;
    const Surfel* surfel;
  };
  struct NormalEquations {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  };
  double finalScale() const;
  void findPairs(const std::vector<SurfacePoint>& points, const Submap& submap,
                 const geometry::Pose2& pose, double scale);
  double descend(const geometry::Pose2& prior, const Eigen::Matrix3d& prior_information,
                 double scale, LineMatch& match) const;
  NormalEquations linearize(const geometry::Pose2& pose, double scale) const;
  static NormalEquations withoutSpurious(const NormalEquations& sum,
                                         const Eigen::Matrix3d& spurious);
  void listResiduals(const std::vector<SurfacePoint>& points, LineMatch& match) const;

  double surface_variance_;
  std::vector<Pair> pairs_;
};

}  // namespace sightline::dead_reckoning
