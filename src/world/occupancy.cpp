#include "sightline/world/occupancy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::world {

namespace {

constexpr double kMargin = 1.0;

Occupancy emptyGrid(const RoomMap& map, double resolution) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const Room& room : map.rooms()) {
    for (const Wall& wall : room.walls) {
      low = low.cwiseMin(wall.segment.start);
      high = high.cwiseMax(wall.segment.start);
    }
  }
  Occupancy grid;
  grid.resolution = resolution;
  grid.origin = low - Eigen::Vector2d::Constant(kMargin);
  const Eigen::Vector2d size = (high - low).array() + 2.0 * kMargin;
  grid.width = static_cast<std::size_t>(std::ceil(size.x() / resolution));
  grid.height = static_cast<std::size_t>(std::ceil(size.y() / resolution));
  grid.cells.assign(grid.width * grid.height, Occupancy::kUnknown);
  return grid;
}

void set(Occupancy& grid, const Eigen::Vector2d& point, std::int8_t value) {
  const Eigen::Vector2d cell = ((point - grid.origin) / grid.resolution).array().floor();
  if (cell.x() < 0.0 || cell.y() < 0.0) return;
  const auto column = static_cast<std::size_t>(cell.x());
  const auto row = static_cast<std::size_t>(cell.y());
  if (column < grid.width && row < grid.height) grid.cells[row * grid.width + column] = value;
}

void drawStretch(Occupancy& grid, const geometry::Segment& segment, double from, double to,
                 std::int8_t value) {
  // Half a cell a step leaves no holes.
  const auto steps = static_cast<int>(std::ceil((to - from) / (0.5 * grid.resolution)));
  for (int i = 0; i <= steps; ++i) {
    const double along = from + (to - from) * i / std::max(steps, 1);
    set(grid, segment.start + along * segment.direction(), value);
  }
}

void fillRoom(Occupancy& grid, const Room& room) {
  for (std::size_t row = 0; row < grid.height; ++row) {
    for (std::size_t column = 0; column < grid.width; ++column) {
      const Eigen::Vector2d centre =
          grid.origin + grid.resolution * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                                          static_cast<double>(row) + 0.5);
      if (room.contains(centre)) grid.cells[row * grid.width + column] = Occupancy::kFree;
    }
  }
}

// The passage of a door: from the wall of one room to that of the other, wall thickness and all.
void openDoor(Occupancy& grid, const RoomMap& map, const Door& door) {
  const geometry::Segment& first = map.rooms()[door.rooms[0]].walls[door.walls[0]].segment;
  const geometry::Segment& second = map.rooms()[door.rooms[1]].walls[door.walls[1]].segment;
  const double depth =
      std::max(first.distance(door.centre_map), second.distance(door.centre_map)) + grid.resolution;
  const Eigen::Vector2d through = first.leftNormal();
  const Eigen::Vector2d across = first.direction();
  for (double d = -depth; d <= depth; d += 0.5 * grid.resolution) {
    const Eigen::Vector2d middle = door.centre_map + d * through;
    const geometry::Segment line{middle - 0.5 * door.width * across,
                                 middle + 0.5 * door.width * across};
    drawStretch(grid, line, 0.0, door.width, Occupancy::kFree);
  }
}

}  // namespace

std::int8_t Occupancy::at(const Eigen::Vector2d& point_map) const {
  const Eigen::Vector2d cell = ((point_map - origin) / resolution).array().floor();
  if (cell.x() < 0.0 || cell.y() < 0.0) return kUnknown;
  const auto column = static_cast<std::size_t>(cell.x());
  const auto row = static_cast<std::size_t>(cell.y());
  return column < width && row < height ? cells[row * width + column] : kUnknown;
}

Occupancy drawRooms(const RoomMap& map, double resolution) {
  Occupancy grid = emptyGrid(map, resolution);
  for (const Room& room : map.rooms()) fillRoom(grid, room);
  for (const Room& room : map.rooms()) {
    for (const Wall& wall : room.walls) {
      drawStretch(grid, wall.segment, 0.0, wall.segment.length(), Occupancy::kOccupied);
    }
  }
  for (const Door& door : map.doors()) openDoor(grid, map, door);
  return grid;
}

}  // namespace sightline::world
