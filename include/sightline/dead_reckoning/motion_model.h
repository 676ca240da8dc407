#pragma once

#include <optional>

#include <Eigen/Core>

#include "sightline/dead_reckoning/correlative_search.h"
#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Mean velocity of the base over the last step, in the base [m/s, m/s, rad/s].
struct Twist {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// The twist that makes a step in so many seconds; none in no time.
Twist twistOf(const geometry::UncertainPose2& step, double elapsed);

/// What a carrier does in the next so many seconds: a velocity that wanders with the carrier's
/// acceleration and is never far beyond half of what is possible (an Ornstein-Uhlenbeck process).
/// The longer the time, the less the last velocity counts.
geometry::UncertainPose2 predictStep(const CarrierConfig& carrier, const Twist& twist,
                                     double elapsed);

/// Three standard deviations of the prediction, but no further than the carrier can get.
SearchWindow windowOf(const CarrierConfig& carrier, const geometry::UncertainPose2& T_odom_base,
                      double elapsed);

}  // namespace sightline::dead_reckoning
