#include <algorithm>
#include <utility>

#include "sightline/world/world.h"

namespace sightline::world {

namespace {

using geometry::Segment;

// Edges of the opening that a door cuts into a wall.
std::pair<Eigen::Vector2d, Eigen::Vector2d> edgesOf(const Door& door, const Wall& wall) {
  const Span opening = openingOf(door, wall);
  const auto at = [&](double along) -> Eigen::Vector2d {
    return wall.segment.start +
           std::clamp(along, 0.0, wall.segment.length()) * wall.segment.direction();
  };
  return {at(opening.from), at(opening.to)};
}

void addJambs(const Door& door, const RoomMap& map, std::vector<Segment>& walls) {
  constexpr double kThinnest = 1e-3;  // walls that touch leave nothing to close
  const auto near = edgesOf(door, map.rooms()[door.rooms[0]].walls[door.walls[0]]);
  auto far = edgesOf(door, map.rooms()[door.rooms[1]].walls[door.walls[1]]);
  // Walls that face each other run in opposite senses.
  if ((near.first - far.second).norm() < (near.first - far.first).norm()) {
    std::swap(far.first, far.second);
  }
  for (const Segment& jamb : {Segment{near.first, far.first}, Segment{near.second, far.second}}) {
    if (jamb.length() > kThinnest) walls.push_back(jamb);
  }
}

}  // namespace

std::vector<Segment> solidWalls(const RoomMap& map) {
  std::vector<Segment> walls;
  for (const Room& room : map.rooms()) {
    for (const Wall& wall : room.walls) {
      const Eigen::Vector2d direction = wall.segment.direction();
      for (const Span& span : wall.spans) {
        walls.push_back(
            {wall.segment.start + span.from * direction, wall.segment.start + span.to * direction});
      }
    }
  }
  for (const Door& door : map.doors()) addJambs(door, map, walls);
  return walls;
}

World World::of(const RoomMap& map) {
  World world;
  for (const Segment& wall : solidWalls(map)) {
    WorldSegment segment;
    segment.segment = wall;
    world.add(segment);
  }
  return world;
}

}  // namespace sightline::world
