#include "sightline/tracking/pose_filter.h"

#include <algorithm>

#include <Eigen/LU>

#include "sightline/motion/sweep_noise.h"
#include "sightline/tracking/line_innovation.h"

namespace sightline::tracking {

using geometry::PolarLine;
using geometry::Pose2;

namespace {

// Walls whose covariance with the pose is kept: more than are seen from anywhere.
constexpr std::size_t kMostWalls = 32;

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
  for (WallCovariance& wall : walls_) wall.with_states.bottomRows<kErrors>().setZero();
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
  const Eigen::Matrix4d predicted = F * covariance_ * F.transpose();
  covariance_.topLeftCorner<4, 4>() = predicted;
  for (WallCovariance& wall : walls_) {
    wall.with_states.topRows<4>() = (F * wall.with_states).eval();
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
  result.covariance_with_states = covariance_ * result.jacobian.transpose();
  result.covariance =
      line.noise + result.wall_jacobian * wall.covariance * result.wall_jacobian.transpose();
  if (const WallCovariance* known = find(wall.wall)) {
    const WithWall by_wall = known->with_states * result.wall_jacobian.transpose();
    result.covariance += (result.jacobian * by_wall).transpose();
    result.covariance_with_states += by_wall;
  }
  result.covariance += result.jacobian * result.covariance_with_states;
  result.nis = result.value.dot(result.covariance.inverse() * result.value);
  return result;
}

const PoseFilter::WallCovariance* PoseFilter::find(const world::WallIndex& wall) const {
  const auto found = std::find_if(walls_.begin(), walls_.end(), [&](const WallCovariance& known) {
    return areSame(known.wall, wall);
  });
  return found == walls_.end() ? nullptr : &*found;
}

void PoseFilter::update(const Innovation& innovation) {
  const WithWall gain = innovation.covariance_with_states * innovation.covariance.inverse();
  const Eigen::Matrix<double, kStates, 1> correction = gain * innovation.value;
  pose_ = Pose2(pose_.coordinates() + correction.head<3>());
  scale_ += correction[3];
  motion_error_ += correction.tail<3 * kKnots>();
  covariance_ -= gain * innovation.covariance * gain.transpose();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  if (!innovation.wall.covariance.isZero(0.0)) updateWalls(innovation, gain);
}

// The errors of walls keep their prior; only what they share with the states changes.
void PoseFilter::updateWalls(const Innovation& innovation, const WithWall& gain) {
  if (!find(innovation.wall.wall)) {
    if (walls_.size() >= kMostWalls) walls_.erase(walls_.begin());
    walls_.push_back({innovation.wall.wall, WithWall::Zero()});
  }
  for (WallCovariance& known : walls_) {
    Eigen::Matrix2d with_value = innovation.jacobian * known.with_states;
    if (areSame(known.wall, innovation.wall.wall)) {
      with_value += innovation.wall_jacobian * innovation.wall.covariance;
    }
    known.with_states -= gain * with_value;
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
  for (WallCovariance& wall : result.walls_) {
    wall.with_states = factors.asDiagonal() * wall.with_states;
  }
  return result;
}

geometry::UncertainPose2 PoseFilter::pose() const {
  return {pose_, covariance_.topLeftCorner<3, 3>()};
}

}  // namespace sightline::tracking
