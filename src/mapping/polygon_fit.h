#pragma once

#include <optional>
#include <vector>

#include "sightline/mapping/room_outline.h"
#include "visible_outline.h"

namespace sightline::mapping {

/// A room by straight sides along an outline: as few as describe it to the size of a cell.
/// Stretches on one line are one side, whatever lies between them; nothing where the sides enclose
/// no room.
std::optional<RoomOutline> polygonAlong(const std::vector<OutlinePoint>& outline);

}  // namespace sightline::mapping
