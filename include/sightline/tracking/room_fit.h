#pragma once

#include <cstddef>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// How the beams of a scan go with the walls of a room, seen from a pose.
struct RoomFit {
  std::size_t on_wall = 0;  ///< ended where a wall is
  std::size_t beyond = 0;   ///< passed through a place where a wall is
  std::size_t occluded =
      0;  ///< ended before the wall: says nothing against the pose, rooms are furnished

  /// Share of the beams that could have met a wall and did; 0 where none could.
  double quality() const {
    const std::size_t met = on_wall + beyond;
    return met == 0 ? 0.0 : static_cast<double>(on_wall) / static_cast<double>(met);
  }
};

/// `tolerance` [m], of the distance from a wall, is for what pose, map and sensor leave open.
RoomFit fitToRoom(const scan::Scan& scan, const geometry::Pose2& T_map_sensor,
                  const world::Room& room, double tolerance);

}  // namespace sightline::tracking
