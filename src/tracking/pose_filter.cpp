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
  if (config_.method == Method::kFull) {
    predictFull(step);
  } else {
    predictPlain(step);
  }
  beginSweep(Eigen::Matrix3d::Zero());
}

void PoseFilter::beginSweep(const Eigen::Matrix3d& motion_covariance) {
  covariance_.rightCols<3>().setZero();
  covariance_.bottomRows<3>().setZero();
  covariance_.bottomRightCorner<3, 3>() = motion_covariance;
  sweep_heading_variance_ = motion_covariance(2, 2);
  motion_error_.setZero();
}

void PoseFilter::predictFull(const Pose2& step) {
  const Pose2 moved = motion::expectedStep(config_.odometry, step, scale_);
  const Eigen::Matrix3d G = geometry::composeJacobianSecond(pose_);
  const Eigen::Matrix3d noise = motion::stepCovariance(config_.odometry, moved);
  // The step begins with the sweep of the last scan. What that scan's walls have said of the
  // sweep's motion holds for this part of the step; only the rest brings new noise. Steps shorter
  // than the sweep, of scanners in turn, are taken as new.
  const double known = noise(2, 2) > 0.0 ? sweep_heading_variance_ / noise(2, 2) : 0.0;
  const bool holds_sweep = known <= 1.0;
  Eigen::Matrix<double, 4, 7> F = Eigen::Matrix<double, 4, 7>::Zero();
  F.leftCols<4>().setIdentity();
  F.topLeftCorner<3, 3>() = geometry::composeJacobianFirst(pose_, moved);
  F.block<2, 1>(0, 3) = pose_.rotation() * moved.translation() / scale_;
  if (holds_sweep) F.topRightCorner<3, 3>() = -G;
  const Eigen::Matrix4d predicted = F * covariance_ * F.transpose();
  covariance_.topLeftCorner<4, 4>() = predicted;
  covariance_.topLeftCorner<3, 3>() +=
      (holds_sweep ? 1.0 - known : 1.0) * G * noise * G.transpose();
  pose_ = pose_ * (holds_sweep ? Pose2(moved.coordinates() - motion_error_) : moved);
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
  result.jacobian.setZero();
  result.jacobian.leftCols<3>() =
      geometry::transformJacobianPose(T_base_map, wall_map) * geometry::inverseJacobian(pose_);
  result.jacobian.rightCols<3>() = sense.asDiagonal() * motion_jacobian;
  result.value = {measured.rho - predicted.rho, geometry::wrapAngle(measured.phi - predicted.phi)};
  result.value -= result.jacobian.rightCols<3>() * motion_error_;
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
  motion_error_ += correction.tail<3>();
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
