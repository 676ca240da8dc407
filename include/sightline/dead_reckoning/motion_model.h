#pragma once

#include <Eigen/Core>

#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/search_window.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// A step to come, in the base before it.
struct StepPrediction {
  geometry::Pose2 step;
  /// Covariance of its coordinates (x, y, θ), were the twist that it was predicted from exact.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// ∂(coordinates)/∂(twist); zero where the prediction is not from a twist.
  Eigen::Matrix3d by_twist = Eigen::Matrix3d::Zero();
};

/// Predicts the step of a carrier in the next `elapsed` seconds from its twist [m/s, m/s, rad/s]:
/// its velocity wanders with the carrier's acceleration and is never far beyond half of what is
/// possible (an Ornstein-Uhlenbeck process). The longer the time, the less the last velocity
/// counts.
StepPrediction predictStep(const CarrierConfig& carrier, const Eigen::Vector3d& twist,
                           double elapsed);

/// ∂(twist)/∂(coordinates) of the constant twist that makes a step in so many seconds.
Eigen::Matrix3d twistJacobian(const geometry::Pose2& step, double elapsed);

/// Three standard deviations of the prediction, but no further than the carrier can get.
SearchWindow windowOf(const CarrierConfig& carrier, const geometry::UncertainPose2& T_odom_base,
                      double elapsed);

}  // namespace sightline::dead_reckoning
