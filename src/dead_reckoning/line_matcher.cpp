#include "sightline/dead_reckoning/line_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

constexpr int kMaxRounds = 12;
// Of the pose, for each choice of counterparts: fewer while these are provisional.
constexpr int kMaxSteps = 4;
constexpr int kMaxFirstSteps = 2;
constexpr double kScaleFall = 0.4;
constexpr double kFinalScale = 3.0;  // in standard deviations
constexpr double kMaxReach = 0.25;   // a counterpart is sought no further than this [m]
// Beyond its own half length a surfel counts a little further [m].
constexpr double kOverhang = 0.03;
// A step as small as this is the last; a pose that moved less than ten of them keeps its pairs.
constexpr double kSettled = 3e-4;      // [m]
constexpr double kTurnSettled = 1e-4;  // [rad]
constexpr double kKeepsPairs = 10.0;
// A direction of which no larger share of the information is real shows nothing: S has errors, too.
constexpr double kLeastShare = 0.3;
constexpr double kLeastInformation = 1e-3;  // where no beam says anything [1/m², 1]

// A sum of weighted outer products v vᵀ: its upper half.
struct Symmetric {
  double xx = 0.0;
  double xy = 0.0;
  double xt = 0.0;
  double yy = 0.0;
  double yt = 0.0;
  double tt = 0.0;

  void add(double weight, const Eigen::Vector3d& v) {
    const Eigen::Vector3d scaled = weight * v;
    xx += scaled.x() * v.x();
    xy += scaled.x() * v.y();
    xt += scaled.x() * v.z();
    yy += scaled.y() * v.y();
    yt += scaled.y() * v.z();
    tt += scaled.z() * v.z();
  }
  Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d full;
    full << xx, xy, xt, xy, yy, yt, xt, yt, tt;
    return full;
  }
};

// Derivative of a residual's Jacobian by the direction of the normal.
Eigen::Vector3d turnedJacobian(const Eigen::Vector2d& normal, const Eigen::Vector2d& arm) {
  return {-normal.y(), normal.x(), normal.dot(arm)};
}

}  // namespace

LineResidual lineResidual(const Eigen::Vector2d& translation_odom, const Eigen::Vector2d& arm_odom,
                          const Surfel& surfel) {
  const Eigen::Vector2d& normal = surfel.normal;
  return {normal.dot(arm_odom + translation_odom - surfel.position),
          {normal.x(), normal.y(), normal.y() * arm_odom.x() - normal.x() * arm_odom.y()}};
}

LineMatch LineMatcher::match(const std::vector<SurfacePoint>& points, const Submap& submap,
                             const Pose2& start, const geometry::UncertainPose2& prior,
                             double start_scale) {
  const Eigen::Matrix3d prior_information = prior.covariance.inverse();
  LineMatch match;
  match.T_odom_base = start;
  double scale = std::max(finalScale(), start_scale);
  bool settled = false;
  for (int i = 0; i < kMaxRounds && !settled; ++i) {
    findPairs(points, submap, match.T_odom_base, scale);
    const double moved = descend(prior.mean, prior_information, scale, match);
    settled = scale == finalScale() && moved < kKeepsPairs;
    scale = std::max(finalScale(), kScaleFall * scale);
  }
  listResiduals(points, match);
  return match;
}

double LineMatcher::finalScale() const {
  return kFinalScale * std::sqrt(2.0 * surface_variance_);
}

void LineMatcher::findPairs(const std::vector<SurfacePoint>& points, const Submap& submap,
                            const Pose2& pose, double scale) {
  const Eigen::Matrix2d rotation = pose.rotation();
  const double reach = std::min(kMaxReach, 2.0 * scale + 0.05);
  pairs_.clear();
  for (const SurfacePoint& point : points) {
    const Eigen::Vector2d place = rotation * point.position + pose.translation();
    const Surfel* surfel = submap.nearest(place, rotation * point.normal, reach);
    if (surfel == nullptr) continue;
    const Eigen::Vector2d off = place - surfel->position;
    const double along = std::abs(surfel->normal.x() * off.y() - surfel->normal.y() * off.x());
    if (along <= surfel->reach + 0.5 * scale + kOverhang) pairs_.push_back({&point, surfel});
  }
}

// Returns how far it went, in units of what counts as settled.
double LineMatcher::descend(const Pose2& prior, const Eigen::Matrix3d& prior_information,
                            double scale, LineMatch& match) const {
  double moved = 0.0;
  double size = 2.0;
  const int most = scale == finalScale() ? kMaxSteps : kMaxFirstSteps;
  for (int i = 0; i < most && size > 1.0; ++i) {
    const NormalEquations normal = linearize(match.T_odom_base, scale);
    Eigen::Vector3d off = match.T_odom_base.coordinates() - prior.coordinates();
    off[2] = geometry::wrapAngle(off[2]);
    const Eigen::Matrix3d information = normal.information + prior_information;
    const Eigen::Vector3d step =
        -information.ldlt().solve(normal.gradient + prior_information * off);
    match.T_odom_base = Pose2(match.T_odom_base.coordinates() + step);
    match.information = normal.information;
    size = std::max(step.head<2>().norm() / kSettled, std::abs(step[2]) / kTurnSettled);
    moved += size;
  }
  return moved;
}

LineMatcher::NormalEquations LineMatcher::linearize(const Pose2& pose, double scale) const {
  const Eigen::Matrix2d rotation = pose.rotation();
  const Eigen::Vector2d translation = pose.translation();
  const double precision = 1.0 / (scale * scale);
  Symmetric information;
  Symmetric spurious;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const Pair& pair : pairs_) {
    const Eigen::Vector2d arm = rotation * pair.point->position;
    const LineResidual residual = lineResidual(translation, arm, *pair.surfel);
    const double robust = 1.0 / (1.0 + residual.value * residual.value * precision);
    const double weight = robust * robust / (pair.point->variance + surface_variance_);
    information.add(weight, residual.jacobian);
    gradient += weight * residual.value * residual.jacobian;
    spurious.add(weight * pair.surfel->normal_variance, turnedJacobian(pair.surfel->normal, arm));
  }
  return withoutSpurious({information.matrix(), gradient}, spurious.matrix());
}

// Normals that err make a straight wall look as if it showed the position along it: of the
// information I only I - S is there, while the gradient has the noise of all of I. In the axes in
// which I is the identity, a direction of which the share λ is real has the error g/λ, of
// information λ².
LineMatcher::NormalEquations LineMatcher::withoutSpurious(const NormalEquations& sum,
                                                          const Eigen::Matrix3d& spurious) {
  const Eigen::Matrix3d regular = sum.information + kLeastInformation * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d root = regular.llt().matrixL();
  const Eigen::Matrix3d whiten = root.inverse();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(whiten * (sum.information - spurious) * whiten.transpose());
  const Eigen::Vector3d share =
      ((solver.eigenvalues().array() - kLeastShare) / (1.0 - kLeastShare)).max(0.0);
  const Eigen::Matrix3d axes = root * solver.eigenvectors();
  return {axes * share.cwiseAbs2().asDiagonal() * axes.transpose(),
          axes * share.asDiagonal() * solver.eigenvectors().transpose() * whiten * sum.gradient};
}

void LineMatcher::listResiduals(const std::vector<SurfacePoint>& points, LineMatch& match) const {
  const Eigen::Matrix2d rotation = match.T_odom_base.rotation();
  match.residuals.assign(points.size(), std::numeric_limits<double>::quiet_NaN());
  match.distances = match.residuals;
  for (const Pair& pair : pairs_) {
    const auto i = static_cast<std::size_t>(pair.point - points.data());
    match.distances[i] =
        lineResidual(match.T_odom_base.translation(), rotation * pair.point->position, *pair.surfel)
            .value;
    match.residuals[i] = match.distances[i] / std::sqrt(pair.point->variance + surface_variance_);
  }
}

}  // namespace sightline::dead_reckoning
