#pragma once

#include <vector>

#include "side_sightings.h"

namespace sightline::mapping {

/// Measures how far the stretches of walls that single scans see lie from the walls' lines:
/// plaster, skirtings and what stands before a wall are no noise that the mean of many scans takes
/// out, but a tracker meets them with each scan anew.
///
/// @param poses  T_map_base of the key scans
void measureUnevenness(const std::vector<SideSighting>& sightings,
                       const std::vector<geometry::Pose2>& poses, std::vector<RoomOutline>& rooms);

}  // namespace sightline::mapping
