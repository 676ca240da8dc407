#pragma once

#include <optional>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/room_outline.h"

namespace sightline::mapping {

/// Rooms, and the middles of their doors, in one frame.
struct RoomLayout {
  std::vector<RoomOutline> rooms;
  std::vector<Eigen::Vector2d> doors;
};

/// How rooms lie in the frame of others of the same building.
struct RoomAlignment {
  geometry::Pose2 T_known_found;
  double agreeing = 0.0;      ///< length of wall that both have [m]
  double contradicted = 0.0;  ///< length of wall of the one well inside a room of the other,
                              ///< and a price for doors of the one where the other has wall [m]
  double rival = 0.0;         ///< the most that agrees, less what contradicts, elsewhere [m]

  double score() const { return agreeing - contradicted; }
  /// Whether the rooms are of one building for sure: much wall agrees, little contradicts, and no
  /// other place explains nearly as much.
  bool isSure() const;
};

/// Lays rooms over others of the same building: every corner of the ones is put on every corner of
/// the others, what agrees best is refined by least squares. Nothing where either have no corner
/// with walls at both sides.
std::optional<RoomAlignment> alignRooms(const RoomLayout& found, const RoomLayout& known);

}  // namespace sightline::mapping
