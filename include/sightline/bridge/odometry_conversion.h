#pragma once

#include <cstdint>
#include <string>

#include <nav_msgs/Odometry.h>

#include "sightline/geometry/pose2.h"

namespace sightline::bridge {

/// Velocity in the body frame: forward, to the left, counter-clockwise [m/s, m/s, rad/s].
struct UncertainTwist2 {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Where and when an odometry message holds.
struct OdometryHeader {
  std::int64_t stamp = 0;   ///< [ns]
  std::string frame;        ///< of the pose
  std::string child_frame;  ///< of the body, and of the twist
};

nav_msgs::Odometry toOdometryMessage(const OdometryHeader& header,
                                     const geometry::UncertainPose2& pose,
                                     const UncertainTwist2& twist);

}  // namespace sightline::bridge
