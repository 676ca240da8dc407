#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/world/room_map.h"

namespace sightline::world {

/// A floor as cells, for planners that want one. Values as in nav_msgs/OccupancyGrid.
struct Occupancy {
  static constexpr std::int8_t kUnknown = -1;
  static constexpr std::int8_t kFree = 0;
  static constexpr std::int8_t kOccupied = 100;

  double resolution = 0.0;                           ///< edge of a cell [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< corner of cell (0, 0) in the map [m]
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::int8_t> cells;  ///< row-major, x first

  std::int8_t at(const Eigen::Vector2d& point_map) const;  ///< unknown outside
};

/// Draws rooms: free inside, occupied along their sides (a robot may not leave through a side where
/// nobody said whether there is a wall), free in doors, unknown elsewhere. A margin of one metre
/// surrounds the rooms.
Occupancy drawRooms(const RoomMap& map, double resolution);

}  // namespace sightline::world
