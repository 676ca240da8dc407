#pragma once

#include <array>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "sightline/geometry/pose2.h"

namespace sightline::bridge {

/// A start pose from rviz or another program. A covariance of zeros is replaced by `sigma`. Throws
/// BadMessage with the reason: another frame than the map's, numbers that are not
/// finite, an orientation that is no rotation, a covariance that is none.
geometry::UncertainPose2 readInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message,
                                         const std::string& map_frame,
                                         const std::array<double, 2>& sigma);

}  // namespace sightline::bridge
