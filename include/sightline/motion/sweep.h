#pragma once

#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::motion {

/// The sensor's pose at each beam, in its frame at the stamp, for a carrier that moves from the
/// stamp to the last beam with constant body velocity. Empty where it stood still or all beams are
/// taken at once.
///
/// @param T_start_end    carrier's pose at the time of the last beam in its frame at the stamp
/// @param T_carrier_sensor  mounting of the sensor
std::vector<geometry::Pose2> sweepMotion(const scan::ScanGeometry& geometry,
                                         const geometry::Pose2& T_start_end,
                                         const geometry::Pose2& T_carrier_sensor);

}  // namespace sightline::motion
