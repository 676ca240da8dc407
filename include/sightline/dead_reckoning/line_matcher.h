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
  /// Information on the coordinates (x, y, θ), by the beams alone and as if their errors were
  /// independent.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Distance of each point from its counterpart's line, in standard deviations; NaN without a
  /// counterpart.
  std::vector<double> residuals;
  std::vector<double> distances;  ///< the same in metres
  /// Covariance of what the noise of the sensor's motion adds to the gradient (MotionGradient).
  Eigen::Matrix3d motion_gradient = Eigen::Matrix3d::Zero();
};

/// Point-to-line matching by iteratively reweighted least squares: the maximum a posteriori pose
/// under Geman-McClure's loss.
class LineMatcher {
 public:
  /// @param surface_sigma  roughness of surfaces and errors of the reference [m]
  explicit LineMatcher(double surface_sigma) : surface_variance_(surface_sigma * surface_sigma) {}

  /// @param start_scale  scale of the loss at first; it falls to that of the noise [m]
  LineMatch match(const SurfaceScan& surfaces, const Submap& submap, const geometry::Pose2& start,
                  const geometry::UncertainPose2& prior, double start_scale) const;

 private:
  struct Pair {
    const SurfacePoint* point;
    const Surfel* surfel;
  };
  using Pairs = std::vector<Pair>;
  struct NormalEquations {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d spurious = Eigen::Matrix3d::Zero();  // what errors of normals add to it
  };
  /// Real part of the information, and the matrix that takes a gradient to the gradient of that
  /// part.
  struct RealPart {
    Eigen::Matrix3d information;
    Eigen::Matrix3d of_gradient;
  };
  double finalScale() const;
  void findPairs(const std::vector<SurfacePoint>& points, const Submap& submap,
                 const geometry::Pose2& pose, double scale, Pairs& pairs) const;
  double descend(const geometry::UncertainPose2& prior, double scale, const Pairs& pairs,
                 LineMatch& match) const;
  double weightOf(const Pair& pair, const LineResidual& residual, double scale) const;
  NormalEquations linearize(const geometry::Pose2& pose, double scale, const Pairs& pairs) const;
  static RealPart realPart(const NormalEquations& sum);
  void listResiduals(const std::vector<SurfacePoint>& points, const Pairs& pairs,
                     LineMatch& match) const;
  void weighMotion(const SurfaceScan& surfaces, const Pairs& pairs, LineMatch& match) const;

  double surface_variance_;
};

}  // namespace sightline::dead_reckoning
