#pragma once

#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Describes by polygons what rectangles describe badly: rooms from within which little of what is
/// seen lies on their sides, as round halls and bays, and places of the path in no room at all. A
/// polygon takes the place of rectangles where it explains enough wall that is oblique to theirs
/// for its number of sides, and leaves out neither wall nor floor of theirs: one along furniture
/// does not.
///
/// @param poses  T_map_base of the key scans
void describeByPolygons(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses,
                        std::vector<RoomOutline>& rooms);

}  // namespace sightline::mapping
