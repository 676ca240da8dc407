#pragma once

#include <Eigen/Core>

namespace sightline::geometry {

/// Velocity in the body frame: forward, to the left, counter-clockwise [m/s, m/s, rad/s], with the
/// covariance of these.
struct UncertainTwist2 {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

}  // namespace sightline::geometry
