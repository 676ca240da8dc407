#pragma once

#include <cstdint>
#include <random>

#include "sightline/geometry/pose2.h"
#include "sightline/geometry/twist2.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/simulation/random_stream.h"

namespace sightline::simulation {

/// Odometry that the wheels report of a robot's motion, with the errors of motion::OdometryNoise:
/// every step fulfils `true = expectedStep(measured, scale) + e` with e drawn from stepCovariance,
/// and one scale is drawn for the whole run.
class WheelOdometry {
 public:
  WheelOdometry(const motion::OdometryNoise& noise, std::uint64_t seed);

  /// Takes a small step that really happened, in the body frame before it.
  void advance(const geometry::Pose2& true_step);

  /// T_odom_base as reported: the sum of the measured steps, nothing taken out. Its covariance is
  /// what spread the model leaves, that of the scale included; the biases are not in it.
  geometry::UncertainPose2 pose() const;
  /// Mean velocity as reported since beginInterval(), which was `duration` [s] ago, with the
  /// covariance that the noise leaves of such a step.
  geometry::UncertainTwist2 twist(double duration) const;
  void beginInterval() { T_odom_begin_ = T_odom_base_; }
  /// Factor from measured to true length of this run.
  double scale() const { return scale_; }

 private:
  geometry::Pose2 measure(const geometry::Pose2& true_step);

  motion::OdometryNoise noise_;
  RandomStream random_;
  std::normal_distribution<double> normal_;
  double scale_;
  geometry::Pose2 T_odom_base_;
  geometry::Pose2 T_odom_begin_;  // at the last beginInterval()
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d scale_jacobian_ = Eigen::Vector3d::Zero();  // ∂T_odom_base/∂scale
};

}  // namespace sightline::simulation
