#pragma once

#include <vector>

#include "sightline/mapping/path_adjuster.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Adjusts the sides of rooms and the path together: each side a free line, its angles with its
/// neighbours right as a soft factor, what each key scan sees of it a measurement of both; besides,
/// the relations of the path, the steps of the wheels with one unknown scale. Sides get covariances
/// of where they are among one another.
void adjustWalls(const std::vector<KeyScan>& keys, AdjustedPath& path,
                 std::vector<RoomOutline>& rooms);

}  // namespace sightline::mapping
