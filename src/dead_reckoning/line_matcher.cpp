#include "sightline/dead_reckoning/line_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "sightline/dead_reckoning/motion_gradient.h"
#include "sightline/dead_reckoning/unbound_axis.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

struct LineTuning {
  // Choices of counterparts, and steps of the pose for each of them: fewer while the counterparts
  // are provisional.
  int max_rounds = 12;
  int max_steps = 4;
  int max_first_steps = 2;
  // Scale of the loss: by how much it falls from one choice to the next, and its last, in standard
  // deviations. Half of that costs 4 points of bad steps on a scanner of 5 cm counts (aces).
  double scale_fall = 0.4;
  double final_scale = 3.0;
  // A counterpart is sought no further than this, and counts a little further than its own half
  // length [m].
  double max_reach = 0.25;
  double overhang = 0.03;
  // A step as small as this is the last [m, rad]; a pose that moved less than `keeps_pairs` of them
  // keeps its counterparts. Five instead of ten costs .35 points of bad steps on the Intel log.
  double settled = 3e-4;
  double turn_settled = 1e-4;
  double keeps_pairs = 10.0;
  // Share of a direction's information up to which nothing of it is taken for real, as the estimate
  // of what is spurious errs too. From 0 to .9 the corridors of aces look the same.
  double least_share = 0.3;
  // Information where no beam says anything [1/m², 1].
  double least_information = 1e-3;
};
constexpr LineTuning kLine{};

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

LineMatch LineMatcher::match(const SurfaceScan& surfaces, const Submap& submap, const Pose2& start,
                             const geometry::UncertainPose2& prior, double start_scale) const {
  LineMatch match;
  match.T_odom_base = start;
  Pairs pairs;
  pairs.reserve(surfaces.points.size());
  double scale = std::max(finalScale(), start_scale);
  bool settled = false;
  for (int i = 0; i < kLine.max_rounds && !settled; ++i) {
    findPairs(surfaces.points, submap, match.T_odom_base, scale, pairs);
    const double moved = descend(prior, scale, pairs, match);
    settled = scale == finalScale() && moved < kLine.keeps_pairs;
    scale = std::max(finalScale(), kLine.scale_fall * scale);
  }
  listResiduals(surfaces.points, pairs, match);
  if (!surfaces.sightings.empty()) weighMotion(surfaces, pairs, match);
  return match;
}

double LineMatcher::finalScale() const {
  return kLine.final_scale * std::sqrt(2.0 * surface_variance_);
}

void LineMatcher::findPairs(const std::vector<SurfacePoint>& points, const Submap& submap,
                            const Pose2& pose, double scale, Pairs& pairs) const {
  const Eigen::Matrix2d rotation = pose.rotation();
  const double reach = std::min(kLine.max_reach, 2.0 * scale + 0.05);
  pairs.clear();
  for (const SurfacePoint& point : points) {
    const Eigen::Vector2d place = rotation * point.position + pose.translation();
    const Surfel* surfel = submap.nearest(place, rotation * point.normal, reach);
    if (surfel == nullptr) continue;
    const Eigen::Vector2d off = place - surfel->position;
    const double along = std::abs(surfel->normal.x() * off.y() - surfel->normal.y() * off.x());
    if (along <= surfel->reach + 0.5 * scale + kLine.overhang) pairs.push_back({&point, surfel});
  }
}

// Returns how far it went, in units of what counts as settled.
double LineMatcher::descend(const geometry::UncertainPose2& prior, double scale, const Pairs& pairs,
                            LineMatch& match) const {
  double moved = 0.0;
  double size = 2.0;
  const int most = scale == finalScale() ? kLine.max_steps : kLine.max_first_steps;
  for (int i = 0; i < most && size > 1.0; ++i) {
    const NormalEquations sum = linearize(match.T_odom_base, scale, pairs);
    const RealPart real = realPart(sum);
    Eigen::Vector3d off = match.T_odom_base.coordinates() - prior.mean.coordinates();
    off[2] = geometry::wrapAngle(off[2]);
    const Eigen::Matrix3d prior_information = prior.covariance.inverse();
    const Eigen::Matrix3d information = real.information + prior_information;
    const Eigen::Vector3d step =
        -information.ldlt().solve(real.of_gradient * sum.gradient + prior_information * off);
    match.T_odom_base = Pose2(match.T_odom_base.coordinates() + step);
    match.information = real.information;
    size = std::max(step.head<2>().norm() / kLine.settled, std::abs(step[2]) / kLine.turn_settled);
    moved += size;
  }
  return moved;
}

double LineMatcher::weightOf(const Pair& pair, const LineResidual& residual, double scale) const {
  const double precision = 1.0 / (scale * scale);
  const double robust = 1.0 / (1.0 + residual.value * residual.value * precision);
  return robust * robust / (pair.point->variance + surface_variance_);
}

LineMatcher::NormalEquations LineMatcher::linearize(const Pose2& pose, double scale,
                                                    const Pairs& pairs) const {
  const Eigen::Matrix2d rotation = pose.rotation();
  const Eigen::Vector2d translation = pose.translation();
  Symmetric information;
  Symmetric spurious;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const Pair& pair : pairs) {
    const Eigen::Vector2d arm = rotation * pair.point->position;
    const LineResidual residual = lineResidual(translation, arm, *pair.surfel);
    const double weight = weightOf(pair, residual, scale);
    information.add(weight, residual.jacobian);
    gradient += weight * residual.value * residual.jacobian;
    spurious.add(weight * pair.surfel->normal_variance, turnedJacobian(pair.surfel->normal, arm));
  }
  return {information.matrix(), gradient, spurious.matrix()};
}

// Normals that err make a straight wall look as if it showed the position along it: of the
// information I only I - S is there, while the gradient has the noise of all of I. In the axes in
// which I is the identity, a direction of which the share λ is real has the error g/λ, of
// information λ².
LineMatcher::RealPart LineMatcher::realPart(const NormalEquations& sum) {
  const Eigen::Matrix3d regular =
      sum.information + kLine.least_information * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d root = regular.llt().matrixL();
  const Eigen::Matrix3d whiten = root.inverse();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(whiten * (sum.information - sum.spurious) * whiten.transpose());
  const Eigen::Vector3d share =
      ((solver.eigenvalues().array() - kLine.least_share) / (1.0 - kLine.least_share)).max(0.0);
  const Eigen::Matrix3d axes = root * solver.eigenvectors();
  return {axes * share.cwiseAbs2().asDiagonal() * axes.transpose(),
          axes * share.asDiagonal() * solver.eigenvectors().transpose() * whiten};
}

// Information and gradient have to be of one real part: in axes that are turned by a hundredth of a
// radian, noise along a direction that is known to millimetres becomes metres in one that is not.
void LineMatcher::weighMotion(const SurfaceScan& surfaces, const Pairs& pairs,
                              LineMatch& match) const {
  const Pose2& pose = match.T_odom_base;
  const Eigen::Matrix2d rotation = pose.rotation();
  MotionGradient gradient(surfaces, pose);
  for (const Pair& pair : pairs) {
    const LineResidual residual =
        lineResidual(pose.translation(), rotation * pair.point->position, *pair.surfel);
    gradient.add(static_cast<std::size_t>(pair.point - surfaces.points.data()), pair.surfel->normal,
                 weightOf(pair, residual, finalScale()) * residual.jacobian);
  }
  const RealPart real = realPart(linearize(pose, finalScale(), pairs));
  match.information = real.information;
  match.motion_gradient = real.of_gradient * gradient.covariance() * real.of_gradient.transpose();
}

void LineMatcher::listResiduals(const std::vector<SurfacePoint>& points, const Pairs& pairs,
                                LineMatch& match) const {
  const Eigen::Matrix2d rotation = match.T_odom_base.rotation();
  match.residuals.assign(points.size(), std::numeric_limits<double>::quiet_NaN());
  match.distances = match.residuals;
  for (const Pair& pair : pairs) {
    const auto i = static_cast<std::size_t>(pair.point - points.data());
    match.distances[i] =
        lineResidual(match.T_odom_base.translation(), rotation * pair.point->position, *pair.surfel)
            .value;
    match.residuals[i] = match.distances[i] / std::sqrt(pair.point->variance + surface_variance_);
  }
}

}  // namespace sightline::dead_reckoning
