#pragma once

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"

namespace sightline::lines {

/// Motion of the base from one scan to the next, and how well it is known.
struct CarrierStep {
  geometry::Pose2 T_before_now;
  /// Covariance of its coordinates (x, y, θ) [m², m rad, rad²], that of the scale apart.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// ∂ translation / ∂ error of the odometry's scale, which is the same in all steps [m].
  Eigen::Vector2d by_scale = Eigen::Vector2d::Zero();

  /// Takes what wheels report, their biases taken out.
  static CarrierStep byWheels(const motion::OdometryNoise& noise,
                              const geometry::Pose2& T_before_now);
  /// Takes what scan matching found.
  static CarrierStep byScans(const geometry::UncertainPose2& T_before_now) {
    return {T_before_now.mean, T_before_now.covariance, Eigen::Vector2d::Zero()};
  }

  /// A point that stands still, in the base before and now.
  Eigen::Vector2d seenNow(const Eigen::Vector2d& before) const {
    return T_before_now.inverse() * before;
  }
  /// What the step's own errors do to such a point, by the covariance [m²].
  Eigen::Matrix2d noiseAt(const Eigen::Vector2d& now) const;
  /// ∂ of such a point / ∂ error of the scale [m].
  Eigen::Vector2d scaleEffect() const { return -T_before_now.rotation().transpose() * by_scale; }
};

}  // namespace sightline::lines
