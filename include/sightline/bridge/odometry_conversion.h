#pragma once

#include <cstdint>
#include <string>

#include <nav_msgs/Odometry.h>

#include "sightline/geometry/pose2.h"
#include "sightline/geometry/twist2.h"

namespace sightline::bridge {

/// Stamp and frames of an odometry message.
struct OdometryHeader {
  std::int64_t stamp = 0;   ///< [ns]
  std::string frame;        ///< of the pose
  std::string child_frame;  ///< of the body, and of the twist
};

nav_msgs::Odometry toOdometryMessage(const OdometryHeader& header,
                                     const geometry::UncertainPose2& pose,
                                     const geometry::UncertainTwist2& twist);

}  // namespace sightline::bridge
