#include "sightline/tracking/pose_filter.h"

#include <Eigen/LU>

#include "sightline/motion/sweep_noise.h"
#include "sightline/tracking/line_innovation.h"

namespace sightline::tracking {

using geometry::PolarLine;
using geometry::Pose2;

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
  covariance_.topLeftCorner<3, 3>() +=
      (holds_sweep ? 1.0 - known : 1.0) * G * noise * G.transpose();
  pose_ = pose_ * (holds_sweep ? Pose2::exp(-motion_error_.tail<3>()) * moved : moved);
  beginSweep({});
}

PoseFilter::Innovation PoseFilter::innovation(const PolarLine& measured_base,
                                              const PolarLine& wall_map,
                                              const LineBySweepError& motion_jacobian) const {
  const LineInnovation line = compareLines(pose_, measured_base, wall_map);
  Innovation result;
  result.jacobian.setZero();
  result.jacobian.leftCols<3>() = line.pose_jacobian;
  result.jacobian.rightCols<3 * kKnots>() = line.sense.asDiagonal() * motion_jacobian;
  result.value = line.value - result.jacobian.rightCols<3 * kKnots>() * motion_error_;
  result.covariance = result.jacobian * covariance_ * result.jacobian.transpose() + line.noise;
  result.nis = result.value.dot(result.covariance.inverse() * result.value);
  return result;
}

void PoseFilter::update(const Innovation& innovation) {
  const Eigen::Matrix<double, kStates, 2> gain =
      covariance_ * innovation.jacobian.transpose() * innovation.covariance.inverse();
  const Eigen::Matrix<double, kStates, 1> correction = gain * innovation.value;
  pose_ = Pose2(pose_.coordinates() + correction.head<3>());
  scale_ += correction[3];
  motion_error_ += correction.tail<3 * kKnots>();
  covariance_ -= gain * innovation.covariance * gain.transpose();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
}

void PoseFilter::inflate(double position_sigma, double heading_sigma) {
  covariance_(0, 0) += position_sigma * position_sigma;
  covariance_(1, 1) += position_sigma * position_sigma;
  covariance_(2, 2) += heading_sigma * heading_sigma;
}

geometry::UncertainPose2 PoseFilter::pose() const {
  return {pose_, covariance_.topLeftCorner<3, 3>()};
}

}  // namespace sightline::tracking
