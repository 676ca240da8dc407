#include "sightline/dead_reckoning/line_matcher.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

constexpr int kMaxIterations = 20;
constexpr double kScaleFall = 0.6;
constexpr double kFinalScale = 3.0;  // in standard deviations
constexpr double kInlier = 0.08;     // [m]
constexpr double kTruncation = 0.2;  // [m]

struct Normal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double inliers = 0.0;
  double cost = 0.0;
};

class Matcher {
 public:
  Matcher(const std::vector<SurfacePoint>& points, const Submap& submap, const PosePrior& prior,
          double surface_sigma)
      : points_(points),
        submap_(submap),
        prior_(prior),
        surface_variance_(surface_sigma * surface_sigma) {}

  LineMatch match(const Pose2& start, double start_scale) {
    LineMatch match;
    match.T_odom_base = start;
    double scale = start_scale;
    for (int i = 0; i < kMaxIterations; ++i) {
      const Normal normal = linearize(match.T_odom_base, scale);
      describe(normal, match);
      const Eigen::Vector3d step = solve(normal, match.T_odom_base);
      match.T_odom_base = Pose2(match.T_odom_base.coordinates() + step);
      const bool finest = scale <= finalScale();
      match.converged = finest && step.head<2>().norm() < 2e-4 && std::abs(step[2]) < 5e-5;
      if (match.converged) break;
      scale = std::max(finalScale(), kScaleFall * scale);
    }
    return match;
  }

 private:
  double finalScale() const { return kFinalScale * std::sqrt(2.0 * surface_variance_); }

  Normal linearize(const Pose2& pose, double scale) const {
    Normal sum;
    const Eigen::Matrix2d rotation = pose.rotation();
    const Eigen::Vector2d translation = pose.translation();
    for (const SurfacePoint& point : points_) {
      const Eigen::Vector2d arm = rotation * point.position;
      const Surfel* surfel = submap_.nearest(arm + translation, rotation * point.normal);
      if (surfel == nullptr) continue;
      add(point, *surfel, arm, arm + translation - surfel->position, scale, sum);
    }
    return sum;
  }

  void add(const SurfacePoint& point, const Surfel& surfel, const Eigen::Vector2d& arm,
           const Eigen::Vector2d& difference, double scale, Normal& sum) const {
    const double along =
        std::abs(surfel.normal.x() * difference.y() - surfel.normal.y() * difference.x());
    if (along > surfel.reach + 0.5 * scale + 0.03) return;
    const double distance = surfel.normal.dot(difference);
    const double ratio = distance / scale;
    const double robust = 1.0 / (1.0 + ratio * ratio);
    const double weight = robust * robust / (point.variance + surface_variance_);
    const Eigen::Vector3d jacobian(surfel.normal.x(), surfel.normal.y(),
                                   surfel.normal.y() * arm.x() - surfel.normal.x() * arm.y());
    sum.information += weight * jacobian * jacobian.transpose();
    sum.gradient += weight * distance * jacobian;
    if (std::abs(distance) < kInlier) sum.inliers += 1.0;
    sum.cost += std::max(0.0, 1.0 - distance * distance / (kTruncation * kTruncation));
  }

  void describe(const Normal& normal, LineMatch& match) const {
    const double count = static_cast<double>(std::max<std::size_t>(1, points_.size()));
    match.information = normal.information;
    match.inliers = normal.inliers / count;
    match.cost = 1.0 - normal.cost / count;
  }

  Eigen::Vector3d solve(const Normal& normal, const Pose2& pose) const {
    Eigen::Vector3d off = pose.coordinates() - prior_.T_odom_base.coordinates();
    off[2] = geometry::wrapAngle(off[2]);
    const Eigen::Matrix3d information = normal.information + prior_.information;
    return -information.ldlt().solve(normal.gradient + prior_.information * off);
  }

  const std::vector<SurfacePoint>& points_;
  const Submap& submap_;
  const PosePrior& prior_;
  double surface_variance_;
};

}  // namespace

LineResidual lineResidual(const Pose2& T_odom_base, const Eigen::Vector2d& point_base,
                          const Surfel& surfel) {
  LineResidual residual;
  residual.value = surfel.normal.dot(T_odom_base * point_base - surfel.position);
  residual.jacobian = surfel.normal.transpose() * geometry::actJacobian(T_odom_base, point_base);
  return residual;
}

LineMatch matchLines(const std::vector<SurfacePoint>& points, const Submap& submap,
                     const Pose2& start, const PosePrior& prior, double surface_sigma,
                     double start_scale) {
  return Matcher(points, submap, prior, surface_sigma).match(start, start_scale);
}

}  // namespace sightline::dead_reckoning
