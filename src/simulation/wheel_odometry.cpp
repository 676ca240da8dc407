#include "sightline/simulation/wheel_odometry.h"

#include <cmath>

namespace sightline::simulation {

WheelOdometry::WheelOdometry(const motion::OdometryNoise& noise, std::uint64_t seed)
    : noise_(noise),
      random_(randomStream(seed, 0)),
      scale_(noise.scale_mean + noise.scale_sigma * normal_(random_)) {}

geometry::Pose2 WheelOdometry::measure(const geometry::Pose2& true_step) {
  const double length = true_step.translation().norm() / scale_;
  const double turn = std::abs(true_step.theta());
  const double root = std::sqrt(length);
  const Eigen::Vector2d slip(noise_.distance_sigma * root * normal_(random_),
                             noise_.lateral_sigma * root * normal_(random_));
  const double drift = noise_.heading_bias_per_metre * length +
                       noise_.heading_sigma_per_metre * root * normal_(random_) +
                       noise_.steering_sigma * std::sqrt(turn) * normal_(random_);
  return {(true_step.translation() - slip) / scale_,
          (true_step.theta() - drift) / (1.0 + noise_.steering_bias)};
}

void WheelOdometry::advance(const geometry::Pose2& true_step) {
  const geometry::Pose2 measured = measure(true_step);
  const Eigen::Matrix3d before = geometry::composeJacobianFirst(T_odom_base_, measured);
  const Eigen::Matrix3d within = geometry::composeJacobianSecond(T_odom_base_);
  covariance_ = before * covariance_ * before.transpose() +
                within * motion::stepCovariance(noise_, measured) * within.transpose();
  const Eigen::Vector3d stretch(measured.x(), measured.y(), 0.0);
  scale_jacobian_ = before * scale_jacobian_ + within * stretch;
  T_odom_base_ = T_odom_base_ * measured;
}

geometry::UncertainTwist2 WheelOdometry::twist(double duration) const {
  const geometry::Pose2 step = geometry::between(T_odom_begin_, T_odom_base_);
  return {step.log() / duration, motion::stepCovariance(noise_, step) / (duration * duration)};
}

geometry::UncertainPose2 WheelOdometry::pose() const {
  const double variance = noise_.scale_sigma * noise_.scale_sigma;
  return {T_odom_base_, covariance_ + variance * scale_jacobian_ * scale_jacobian_.transpose()};
}

}  // namespace sightline::simulation
