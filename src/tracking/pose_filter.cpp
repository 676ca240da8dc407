#include "sightline/tracking/pose_filter.h"

#include <algorithm>

#include <Eigen/LU>

#include "sightline/motion/sweep_noise.h"
#include "sightline/tracking/line_innovation.h"

namespace sightline::tracking {

using geometry::PolarLine;
using geometry::Pose2;

namespace {

// Walls and jambs whose share in the error of the pose is kept apart: more than are seen from
// anywhere.
constexpr std::size_t kMostWalls = 48;

bool areSame(const world::WallIndex& a, const world::WallIndex& b) {
  return a.room == b.room && a.wall == b.wall;
}

}  // namespace

PoseFilter::PoseFilter(const motion::OdometryNoise& odometry, const geometry::UncertainPose2& start)
    : pose_(start.mean), scale_(odometry.scale_mean) {
  covariance_.topLeftCorner<3, 3>() = start.covariance;
  covariance_(3, 3) = odometry.scale_sigma * odometry.scale_sigma;
}

void PoseFilter::beginSweep(const SweepNoise& motion_noise) {
  constexpr int kErrors = 3 * kKnots;
  covariance_.rightCols<kErrors>().setZero();
  covariance_.bottomRows<kErrors>().setZero();
  covariance_.bottomRightCorner<kErrors, kErrors>() = motion_noise.atKnots();
  for (WallShare& wall : walls_) wall.of_states.bottomRows<kErrors>().setZero();
  sweep_heading_variance_ = motion_noise.atEnd()(2, 2);
  motion_error_.setZero();
}

void PoseFilter::predict(const motion::OdometryNoise& odometry, const Pose2& step) {
  const Pose2 moved = motion::expectedStep(odometry, step, scale_);
  const Eigen::Matrix3d G = geometry::composeJacobianSecond(pose_);
  const Eigen::Matrix3d noise = motion::stepCovariance(odometry, moved);
  // The step begins with the sweep of the last scan. What that scan's walls have said of the
  // sweep's motion holds for this part of the step; only the rest brings new noise. Steps shorter
  // than the sweep, of scanners in turn, are taken as new, and so is a sweep that knew less of its
  // motion than this odometry would have.
  const double known = noise(2, 2) > 0.0 ? sweep_heading_variance_ / noise(2, 2) : 0.0;
  const bool holds_sweep = known <= 1.0;
  Eigen::Matrix<double, 4, kStates> F = Eigen::Matrix<double, 4, kStates>::Zero();
  F.leftCols<4>().setIdentity();
  F.topLeftCorner<3, 3>() = geometry::composeJacobianFirst(pose_, moved);
  F.block<2, 1>(0, 3) = pose_.rotation() * moved.translation() / scale_;
  if (holds_sweep) F.topRightCorner<3, 3>() = -G * motion::coordinatesByStartTwist(moved);
  const Eigen::Matrix<double, 4, kStates> spread = F.lazyProduct(covariance_);
  const Eigen::Matrix4d predicted = spread.lazyProduct(F.transpose());
  covariance_.topLeftCorner<4, 4>() = predicted;
  for (WallShare& wall : walls_) {
    wall.of_states.topRows<4>() = F.lazyProduct(wall.of_states).eval();
  }
  covariance_.topLeftCorner<3, 3>() +=
      (holds_sweep ? 1.0 - known : 1.0) * G * noise * G.transpose();
  pose_ = pose_ * (holds_sweep ? Pose2::exp(-motion_error_.tail<3>()) * moved : moved);
  beginSweep({});
}

PoseFilter::Innovation PoseFilter::innovation(const PolarLine& measured_base,
                                              const PolarLine& wall_map,
                                              const LineBySweepError& motion_jacobian,
                                              const WallError& wall) const {
  const LineInnovation line = compareLines(pose_, measured_base, wall_map);
  Innovation result;
  result.wall = wall;
  result.jacobian.setZero();
  result.jacobian.leftCols<3>() = line.pose_jacobian;
  result.jacobian.rightCols<3 * kKnots>() = line.sense.asDiagonal() * motion_jacobian;
  result.wall_jacobian =
      geometry::transformJacobianLine(pose_.inverse(), wall_map) * wall.line_jacobian;
  result.value = line.value - result.jacobian.rightCols<3 * kKnots>() * motion_error_;
  result.covariance_with_states = covariance_.lazyProduct(result.jacobian.transpose());
  result.covariance = line.noise + result.jacobian * result.covariance_with_states;
  result.nis = result.value.dot(result.covariance.inverse() * result.value);
  return result;
}

PoseFilter::WallShare& PoseFilter::shareOf(const WallError& wall) {
  const auto found = std::find_if(walls_.begin(), walls_.end(), [&](const WallShare& known) {
    return areSame(known.wall, wall.wall);
  });
  if (found != walls_.end()) return *found;
  if (walls_.size() >= kMostWalls) {
    covariance_ += walls_.front().covariance();
    walls_.erase(walls_.begin());
  }
  walls_.push_back({wall.wall, wall.covariance, ByWall::Zero()});
  return walls_.back();
}

void PoseFilter::update(const Innovation& innovation) {
  const ByWall gain =
      innovation.covariance_with_states.lazyProduct(innovation.covariance.inverse().eval());
  const Eigen::Matrix<double, kStates, 1> correction = gain * innovation.value;
  pose_ = Pose2(pose_.coordinates() + correction.head<3>());
  scale_ += correction[3];
  motion_error_ += correction.tail<3 * kKnots>();
  const ByWall spread = gain.lazyProduct(innovation.covariance);
  covariance_ -= spread.lazyProduct(gain.transpose());
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  if (!innovation.wall.covariance.isZero(0.0)) updateWalls(innovation, gain);
}

// What the error of each wall has done to the states, now that this wall has corrected them.
void PoseFilter::updateWalls(const Innovation& innovation, const ByWall& gain) {
  const WallShare& share = shareOf(innovation.wall);
  for (WallShare& known : walls_) {
    Eigen::Matrix2d by_wall = innovation.jacobian * known.of_states;
    if (&known == &share) by_wall += innovation.wall_jacobian;
    known.of_states -= gain * by_wall;
  }
}

void PoseFilter::inflate(double position_sigma, double heading_sigma) {
  covariance_(0, 0) += position_sigma * position_sigma;
  covariance_(1, 1) += position_sigma * position_sigma;
  covariance_(2, 2) += heading_sigma * heading_sigma;
}

PoseFilter PoseFilter::limited(double position_sigma, double heading_sigma) const {
  PoseFilter result = *this;
  Eigen::Matrix<double, kStates, 1> factors = Eigen::Matrix<double, kStates, 1>::Ones();
  const Eigen::Vector3d limits(position_sigma, position_sigma, heading_sigma);
  for (int i = 0; i < 3; ++i) {
    const double sigma = std::sqrt(covariance_(i, i));
    if (sigma > limits[i]) factors[i] = limits[i] / sigma;
  }
  result.covariance_ = factors.asDiagonal() * covariance_ * factors.asDiagonal();
  for (WallShare& wall : result.walls_) wall.of_states = factors.asDiagonal() * wall.of_states;
  return result;
}

geometry::UncertainPose2 PoseFilter::assumedPose() const {
  return {pose_, covariance_.topLeftCorner<3, 3>()};
}

geometry::UncertainPose2 PoseFilter::pose() const {
  geometry::UncertainPose2 pose = assumedPose();
  for (const WallShare& wall : walls_) {
    const auto by_wall = wall.of_states.topRows<3>();
    pose.covariance += by_wall.lazyProduct(wall.prior).eval().lazyProduct(by_wall.transpose());
  }
  return pose;
}

}  // namespace sightline::tracking
