#pragma once

#include <cstddef>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/world/room_view.h"

namespace sightline::tracking {

/// Agreement of the beams of a scan with the walls of a map, seen from a pose.
struct ScanAgreement {
  std::size_t on_wall = 0;  ///< ended where a wall is
  std::size_t beyond = 0;   ///< passed through a place where a wall is
  std::size_t occluded =
      0;  ///< ended before the wall: says nothing against the pose, rooms are furnished

  /// Beams that say something for or against the pose.
  std::size_t evidence() const { return on_wall + beyond; }
  /// Share of the beams that could have met a wall and did; 0 where none could.
  double quality() const {
    return evidence() == 0 ? 0.0 : static_cast<double>(on_wall) / static_cast<double>(evidence());
  }
  /// Beams that speak for the pose less those that speak against it.
  long support() const { return static_cast<long>(on_wall) - static_cast<long>(beyond); }
};

/// `tolerance` [m], of the distance from a wall and of the place on it, is for what pose, map and
/// sensor leave open. The view has to be that of the pose, T_map_sensor.
ScanAgreement scanAgreement(const scan::Scan& scan, const geometry::Pose2& T_map_sensor,
                            const world::RoomView& view, double tolerance);

}  // namespace sightline::tracking
