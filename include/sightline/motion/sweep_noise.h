#pragma once

#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/scan/motion_noise.h"

namespace sightline::motion {

/// What wheels leave unknown of a sensor's motion within a sweep: the error of their motion from
/// the first beam to the last, in the sensor's frame.
///
/// @param T_start_end_base  the base's pose at the last beam in its frame at the first one
scan::MotionNoise sweepNoise(const OdometryNoise& noise, const geometry::Pose2& T_start_end_base,
                             const geometry::Pose2& T_base_sensor);

}  // namespace sightline::motion
