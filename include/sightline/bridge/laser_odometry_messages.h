#pragma once

#include <string>

#include <nav_msgs/Odometry.h>

#include "sightline/dead_reckoning/dead_reckoner.h"

namespace sightline::bridge {

/// Pose in the odometry frame and twist in the base frame, both with covariance, at the stamp of
/// the scan.
nav_msgs::Odometry toLaserOdometryMessage(const dead_reckoning::DeadReckoningUpdate& update,
                                          const std::string& odom_frame,
                                          const std::string& base_frame);

/// Name of a state, one word.
const char* nameOf(dead_reckoning::MatchState state);

}  // namespace sightline::bridge
