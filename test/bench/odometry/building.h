#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "sightline/simulation/path.h"
#include "sightline/simulation/random_stream.h"
#include "sightline/world/world.h"

namespace sightline::bench {

/// Rooms and corridors drawn at random, one behind the other, and a way through all of them: a
/// corridor, a room, a short corridor to the left or right, a room, the next corridor back, and so
/// on.
struct Building {
  world::World world;
  std::vector<Eigen::Vector2d> way;  ///< from door to door and once about each room [m]
};

/// Puts up walls; all lengths in metres.
class Builder {
 public:
  explicit Builder(std::uint64_t seed) : random_(simulation::randomStream(seed, 11)) {
    world_.add(world::WorldPlate{{}, 0.0, 0});
    world_.add(world::WorldPlate{{}, kCeiling, 0});
  }

  Building serpentine(double length) {
    for (int row = 0; wayLength() < length; ++row) addRow(row);
    shutDoor(way_.back());
    way_.back().y() -= 1.0;
    return {std::move(world_), std::move(way_)};
  }

  Building corridor(double length, double beyond) {
    const double half = 0.5 * draw(1.8, 2.4);
    wallWithRecesses({-beyond, -half}, {length + beyond, -half});
    wallWithRecesses({length + beyond, half}, {-beyond, half});
    return {std::move(world_), {{0.0, 0.0}, {length, 0.0}}};
  }

 private:
  using Point = Eigen::Vector2d;
  static constexpr double kCeiling = 2.6;
  static constexpr double kDoor = 1.0;       // width
  static constexpr double kWall = 0.15;      // thickness
  static constexpr double kRowPitch = 14.0;  // between one corridor and the next
  static constexpr double kToDoor = 3.0;     // from a corridor's middle to the door beside its end

  double draw(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  double wayLength() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < way_.size(); ++i) sum += (way_[i] - way_[i - 1]).norm();
    return sum;
  }

  void wall(const Point& from, const Point& to, double top = kCeiling) {
    if ((to - from).norm() < 1e-6) return;
    world::WorldSegment segment;
    segment.segment = {from, to};
    segment.top = top;
    world_.add(segment);
  }

  // A wall to the left of which lies the open, with a shut door set back every three to six metres.
  void wallWithRecesses(const Point& from, const Point& to) {
    const double length = (to - from).norm();
    const Point along = (to - from) / length;
    const Point back(along.y(), -along.x());
    double done = 0.0;
    for (double at = draw(1.0, 3.0); at + 1.0 < length; at += draw(3.0, 6.0)) {
      const double depth = draw(0.12, 0.3);
      const Point left = from + at * along;
      const Point right = left + 0.9 * along;
      wall(from + done * along, left);
      wall(left, left + depth * back);
      wall(left + depth * back, right + depth * back);
      wall(right + depth * back, right);
      done = at + 0.9;
    }
    wall(from + done * along, to);
  }

  // A wall with doorways at these distances from its beginning, in order, as deep as the wall.
  void wallWithDoors(const Point& from, const Point& to, const std::vector<double>& doors) {
    const Point along = (to - from).normalized();
    const Point back(along.y(), -along.x());
    double done = 0.0;
    for (const double door : doors) {
      const Point left = from + (door - 0.5 * kDoor) * along;
      const Point right = from + (door + 0.5 * kDoor) * along;
      wall(from + done * along, left);
      wall(left, left + kWall * back);
      wall(right + kWall * back, right);
      done = door + 0.5 * kDoor;
    }
    wall(from + done * along, to);
  }

  // A doorway in a wall along x.
  void shutDoor(const Point& at) {
    wall(at - Point(0.5 * kDoor, 0.0), at + Point(0.5 * kDoor, 0.0));
  }

  void box(const Point& centre, const Point& size, double top) {
    const Point half = 0.5 * size;
    const Point across(half.x(), -half.y());
    const std::vector<Point> corners{centre - half, centre + across, centre + half,
                                     centre - across};
    for (std::size_t i = 0; i < 4; ++i) wall(corners[i], corners[(i + 1) % 4], top);
    world_.add(world::WorldPlate{corners, top, 0});
  }

  // Along x, between x0 and x1, its middle at y; both ends open into doors.
  void corridorAlongX(double x0, double x1, double y) {
    const double half = 0.5 * draw(1.8, 2.4);
    wallWithRecesses({x0, y - half}, {x1, y - half});
    wallWithRecesses({x1, y + half}, {x0, y + half});
    wallWithDoors({x0, y + half}, {x0, y - half}, {half});
    wallWithDoors({x1, y - half}, {x1, y + half}, {half});
  }

  void corridorAlongY(double x, double y0, double y1) {
    const double half = 0.5 * draw(1.8, 2.4);
    wallWithRecesses({x + half, y0}, {x + half, y1});
    wallWithRecesses({x - half, y1}, {x - half, y0});
    wallWithDoors({x - half, y0}, {x + half, y0}, {half});
    wallWithDoors({x + half, y1}, {x - half, y1}, {half});
  }

  struct Room {
    double x0, x1, y0, y1;
  };

  // Cupboards against the walls, clear of the middle.
  void furnish(const Room& room) {
    box({room.x0 + 0.3, room.y0 + draw(0.6, 1.2)}, {0.5, 0.9}, 2.0);
    box({room.x1 - 0.3, room.y1 - draw(0.6, 1.2)}, {0.5, 0.8}, 2.0);
    box({room.x0 + draw(0.8, 1.2), room.y1 - 0.4}, {1.2, 0.5}, 1.8);
    box({room.x1 - draw(0.5, 1.0), room.y0 + 0.3}, {0.8, 0.4}, 1.8);
  }

  // The room at the end of a row: one door to the row's corridor, at y, one to the short corridor
  // to the next or from the last row, at x, on the side that `upwards` says.
  Room endRoom(double corridor_end, double y, bool is_east, bool upwards, double x_door) {
    Room room{};
    const double width = draw(5.0, 7.0);
    room.x0 = is_east ? corridor_end + kWall : corridor_end - kWall - width;
    room.x1 = room.x0 + width;
    room.y0 = y - (upwards ? draw(2.2, 3.5) : kToDoor);
    room.y1 = y + (upwards ? kToDoor : draw(2.2, 3.5));
    const std::vector<double> none;
    wallWithDoors({room.x0, room.y0}, {room.x1, room.y0},
                  upwards ? none : std::vector<double>{x_door - room.x0});
    wallWithDoors({room.x1, room.y0}, {room.x1, room.y1},
                  is_east ? none : std::vector<double>{y - room.y0});
    wallWithDoors({room.x1, room.y1}, {room.x0, room.y1},
                  upwards ? std::vector<double>{room.x1 - x_door} : none);
    wallWithDoors({room.x0, room.y1}, {room.x0, room.y0},
                  is_east ? std::vector<double>{room.y1 - y} : none);
    furnish(room);
    return room;
  }

  // One row: the room in which it begins, its corridor, the room in which it ends, and the short
  // corridor to the next row.
  void addRow(int row) {
    const bool eastwards = row % 2 == 0;
    const double y = kRowPitch * row;
    const double x0 = 0.0;
    const double x1 = 18.0;
    const double start = eastwards ? x0 : x1;
    const double end = eastwards ? x1 : x0;
    const double into = eastwards ? 2.5 : -2.5;
    const double x_in = start - into;
    const double x_out = end + into;
    endRoom(start, y, !eastwards, false, x_in);
    if (row == 0) shutDoor({x_in, y - kToDoor});
    way_.emplace_back(x_in, y - 1.5);
    way_.emplace_back(x_in, y);
    corridorAlongX(x0, x1, y);
    way_.emplace_back(start, y);
    way_.emplace_back(end, y);
    endRoom(end, y, eastwards, true, x_out);
    // Once about the middle of the room, so that the person also looks back.
    const double turn = eastwards ? 1.0 : -1.0;
    way_.emplace_back(x_out, y);
    way_.emplace_back(x_out + 0.8 * turn, y + 0.9);
    way_.emplace_back(x_out, y + 1.5);
    way_.emplace_back(x_out - 0.8 * turn, y + 0.5);
    way_.emplace_back(x_out, y);
    way_.emplace_back(x_out, y + 2.0);
    corridorAlongY(x_out, y + kToDoor + kWall, y + kRowPitch - kToDoor - kWall);
    way_.emplace_back(x_out, y + kToDoor);
    way_.emplace_back(x_out, y + kRowPitch - kToDoor);
  }

  simulation::RandomStream random_;
  world::World world_;
  std::vector<Point> way_;
};

/// A building with a way of at least this length [m].
inline Building serpentineBuilding(double length, std::uint64_t seed) {
  return Builder(seed).serpentine(length);
}

/// A straight corridor with shut doors set back every three to six metres, its ends beyond the
/// reach of a scanner that sees `reach` [m], with a way of this length in its middle.
inline Building recessedCorridor(double length, double reach, std::uint64_t seed) {
  return Builder(seed).corridor(length, reach + 1.0);
}

/// A straight corridor without anything in it, 2 m wide, its ends beyond the reach of a scanner
/// that sees `reach` [m], with a way of this length in its middle.
inline Building plainCorridor(double length, double reach) {
  Building building;
  building.world.add(world::WorldPlate{{}, 0.0, 0});
  building.world.add(world::WorldPlate{{}, 2.6, 0});
  for (const double y : {-1.0, 1.0}) {
    world::WorldSegment segment;
    segment.segment = {{-reach - 1.0, y}, {length + reach + 1.0, y}};
    segment.top = 2.6;
    building.world.add(segment);
  }
  building.way = {{0.0, 0.0}, {length, 0.0}};
  return building;
}

}  // namespace sightline::bench
