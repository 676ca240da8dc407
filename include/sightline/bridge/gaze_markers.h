#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "sightline/gaze/gaze_control.h"

namespace sightline::bridge {

/// Draws where a head looks: the field of view in the mount's frame, and the way to the feature
/// that is fixated in that of the odometry.
visualization_msgs::MarkerArray gazeMarkers(const gaze::GazeControl& gaze, double head_angle,
                                            const std_msgs::Header& mount,
                                            const std::string& odom_frame,
                                            const geometry::Pose2& T_odom_mount);

}  // namespace sightline::bridge
