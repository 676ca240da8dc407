#include "sightline/tracking/pose_filter.h"

#include <algorithm>

#include <Eigen/LU>

namespace sightline::tracking {

using geometry::PolarLine;
using geometry::Pose2;

PoseFilter::PoseFilter(const TrackerConfig& config, const geometry::UncertainPose2& start)
    : config_(config), pose_(start.mean), scale_(config.odometry.scale_mean) {
  covariance_.topLeftCorner<3, 3>() = start.covariance;
  // The plain method takes the mean scale for the truth.
  if (config.method == Method::kFull) {
    covariance_(3, 3) = config.odometry.scale_sigma * config.odometry.scale_sigma;
  }
}

void PoseFilter::predict(const Pose2& step) {
  beginSweep(Eigen::Matrix3d::Zero());
  if (config_.method == Method::kFull) {
    predictFull(step);
  } else {
    predictPlain(step);
  }
}

void PoseFilter::beginSweep(const Eigen::Matrix3d& motion_covariance) {
  covariance_.rightCols<3>().setZero();
  covariance_.bottomRows<3>().setZero();
  covariance_.bottomRightCorner<3, 3>() = motion_covariance;
}

void PoseFilter::predictFull(const Pose2& step) {
  const Pose2 moved = motion::expectedStep(config_.odometry, step, scale_);
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
  F.topLeftCorner<3, 3>() = geometry::composeJacobianFirst(pose_, moved);
  F.topRightCorner<2, 1>() = pose_.rotation() * step.translation();
  const Eigen::Matrix3d G = geometry::composeJacobianSecond(pose_);
  covariance_.topLeftCorner<4, 4>() = F * covariance() * F.transpose();
  covariance_.topLeftCorner<3, 3>() +=
      G * motion::stepCovariance(config_.odometry, moved) * G.transpose();
  pose_ = pose_ * moved;
}

void PoseFilter::predictPlain(const Pose2& step) {
  // jensfelt eqs 5 and 8: the step is added, and its noise too, as if heading and position had
  // nothing to do with each other.
  const Pose2 moved = motion::expectedStep(config_.odometry, step, scale_);
  const Eigen::Matrix3d G = geometry::composeJacobianSecond(pose_);
  const Eigen::Matrix3d noise = motion::stepCovariance(config_.odometry, moved);
  covariance_.topLeftCorner<3, 3>() +=
      G * Eigen::Matrix3d(noise.diagonal().asDiagonal()) * G.transpose();
  pose_ = pose_ * moved;
}

PoseFilter::Innovation PoseFilter::innovation(
    const PolarLine& measured_base, const PolarLine& wall_map,
    const Eigen::Matrix<double, 2, 3>& motion_jacobian) const {
  const Pose2 T_base_map = pose_.inverse();
  const PolarLine predicted = geometry::transform(T_base_map, wall_map);
  const PolarLine measured = geometry::describedLike(predicted, measured_base);
  // Described by the opposite normal, ρ changes its sign and φ does not.
  const Eigen::Vector2d sense(measured.rho == measured_base.rho ? 1.0 : -1.0, 1.0);
  Innovation result;
  result.value = {measured.rho - predicted.rho, geometry::wrapAngle(measured.phi - predicted.phi)};
  result.jacobian.setZero();
  result.jacobian.leftCols<3>() =
      geometry::transformJacobianPose(T_base_map, wall_map) * geometry::inverseJacobian(pose_);
  result.jacobian.rightCols<3>() = sense.asDiagonal() * motion_jacobian;
  result.covariance =
      result.jacobian * covariance_ * result.jacobian.transpose() + measured.covariance;
  result.nis = result.value.dot(result.covariance.inverse() * result.value);
  return result;
}

void PoseFilter::update(const Innovation& innovation) {
  const Eigen::Matrix<double, 7, 2> gain =
      covariance_ * innovation.jacobian.transpose() * innovation.covariance.inverse();
  const Eigen::Matrix<double, 7, 1> correction = gain * innovation.value;
  pose_ = Pose2(pose_.coordinates() + correction.head<3>());
  scale_ += correction[3];
  covariance_ -= gain * innovation.covariance * gain.transpose();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
}

void PoseFilter::inflate(double position_sigma, double heading_sigma) {
  covariance_(0, 0) += position_sigma * position_sigma;
  covariance_(1, 1) += position_sigma * position_sigma;
  covariance_(2, 2) += heading_sigma * heading_sigma;
}

void PoseFilter::applyFloor() {
  const double position = config_.floor_position_sigma * config_.floor_position_sigma;
  const double heading = config_.floor_heading_sigma * config_.floor_heading_sigma;
  covariance_(0, 0) = std::max(covariance_(0, 0), position);
  covariance_(1, 1) = std::max(covariance_(1, 1), position);
  covariance_(2, 2) = std::max(covariance_(2, 2), heading);
}

geometry::UncertainPose2 PoseFilter::pose() const {
  return {pose_, covariance_.topLeftCorner<3, 3>()};
}

}  // namespace sightline::tracking
