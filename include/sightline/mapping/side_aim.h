#pragma once

#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Moves each side onto the line that most of its length speaks for. Least squares takes all that
/// is near for the wall: a side of which one half is wall and the other a row of cupboards ends
/// oblique between the two, whatever its factors forgive. Here each piece of a side counts once,
/// however often it was seen, with the share of what was seen there that lies on the line; a turn
/// away from the side's room costs length. A side that lies well already stays as it is,
/// and so do polygons: along a round wall most of what is near a side is not on its line.
///
/// @param found  the rooms as they were found, which know how the building is turned
void aimSides(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses,
              const std::vector<RoomOutline>& found, std::vector<RoomOutline>& rooms);

}  // namespace sightline::mapping
