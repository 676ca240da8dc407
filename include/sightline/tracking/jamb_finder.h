#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"
#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/wall_error.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// End of a wall at a door, where the map says that the wall is solid up to there.
struct Jamb {
  std::size_t door = 0;
  std::size_t room = 0;   ///< from which it is seen
  bool is_start = false;  ///< whether the opening begins there, in the direction of the wall
  double along = 0.0;     ///< place on the wall, metres from its start

  /// Line through the jamb across its wall, in the map: the place along the wall is all it tells.
  geometry::PolarLine lineIn(const world::RoomMap& map) const;
  /// The map's error of its place, as a constant; see WallError.
  WallError errorIn(const DoorConfig& config) const;
};

/// A jamb in a scan: one beam ends on the wall, and its neighbour passes through the opening.
struct SeenJamb {
  Jamb jamb;
  /// Line through the edge across the wall, in the base frame. Its direction is unknown, so that it
  /// measures a place and no heading.
  geometry::PolarLine line;
};

/// Finds the jambs of the doors of a room in a scan (jensfelt section 5.3: "extend the model and
/// track the position of doors as well"). A jamb counts where one edge alone lies within its gate.
std::vector<SeenJamb> findJambs(const TrackerConfig& config, const PoseFilter& filter,
                                const world::RoomMap& map, std::size_t room, const Sweep& sweep);

}  // namespace sightline::tracking
