#pragma once

#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Finds rooms about a path: rectangles along each of the building's directions, whichever explains
/// most comes first.
///
/// @param poses  T_map_base of the key scans
std::vector<RoomOutline> searchRooms(const std::vector<KeyScan>& keys,
                                     const std::vector<geometry::Pose2>& poses);

}  // namespace sightline::mapping
