#pragma once

#include <random>
#include <vector>

#include <fmt/format.h>

#include "bench/rooms/recorded_drive.h"
#include "sightline/world/world.h"

namespace sightline::bench {

/// A floor drawn at random: 4 to 12 rooms on both sides of a corridor, each driven through once,
/// and if it is furnished with shelves before the walls and tables.
class RandomFloor {
 public:
  RandomFloor(std::uint64_t seed, bool is_furnished) : random_(seed) {
    const int rooms = 4 + static_cast<int>(random_() % 9);
    for (int i = 0; i < rooms; ++i) addRoom(i, i % 2 == 0 ? 1.0 : -1.0);
    addCorridor();
    for (const Door& door : doors_) map_.addDoor(door.room, corridor_, door.at, 0.9);
    world_ = world::World::of(map_);
    for (const Eigen::Vector4d& room : extents_) {
      if (is_furnished) furnish(room);
    }
  }

  const world::RoomMap& map() const { return map_; }

  /// A drive from the corridor's end through all rooms and back; odometry 2 % short.
  DriveSetup drive() const {
    DriveSetup setup;
    setup.world = world_;
    setup.start = {begin_ + 1.0, 0.1, 0.1};
    setup.path.speed = 0.5;
    setup.path.turn_rate = 0.8;
    setup.path.tolerance = 0.2;
    setup.path.waypoints_map = way();
    setup.scanner.beams = 361;
    setup.scanner.angle_min = -0.5 * geometry::kPi;
    setup.scanner.angle_max = 0.5 * geometry::kPi;
    setup.scanner.range_max = 20.0;
    setup.scanner.rate = 5.0;
    setup.scanner.noise.sigma = 0.01;
    setup.height = 0.4;
    setup.robot.odometry.scale_mean = 1.02;
    setup.robot.odometry.scale_sigma = 0.0;
    Eigen::Vector2d before = setup.start.translation();
    double length = 0.0;
    for (const Eigen::Vector2d& point : setup.path.waypoints_map) {
      length += (point - before).norm();
      before = point;
    }
    setup.seconds =
        length / setup.path.speed + 5.0 * static_cast<double>(setup.path.waypoints_map.size());
    return setup;
  }

 private:
  struct Door {
    std::size_t room;
    Eigen::Vector2d at;
  };
  static constexpr double kHalf = 1.1;  // width of the corridor [m]
  static constexpr double kWall = 0.14;

  double draw(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  void addRoom(int number, double side) {
    double& at = side > 0.0 ? above_ : below_;
    const double width = draw(3.2, 6.5);
    const double depth = draw(3.2, 6.0);
    const Eigen::Vector2d centre(at + 0.5 * width, side * (kHalf + kWall + 0.5 * depth));
    const std::size_t room =
        map_.addRectangle(fmt::format("room {}", number), {width, depth}, {centre, 0.0});
    doors_.push_back({room, {at + draw(0.9, width - 0.9), side * (kHalf + 0.5 * kWall)}});
    extents_.emplace_back(at, at + width, side * (kHalf + kWall), side * (kHalf + kWall + depth));
    at += width + kWall;
  }

  void addCorridor() {
    begin_ = -draw(0.3, 1.5);
    const double end = std::max(above_, below_) + draw(0.3, 1.5);
    corridor_ = map_.addRectangle("corridor", {end - begin_, 2.0 * kHalf},
                                  {0.5 * (begin_ + end), 0.0, 0.0});
    end_ = end;
  }

  std::vector<Eigen::Vector2d> way() const {
    std::vector<Eigen::Vector2d> way;
    for (std::size_t i = 0; i < doors_.size(); ++i) {
      const Eigen::Vector4d& e = extents_[i];
      const double side = e[2] > 0.0 ? 1.0 : -1.0;
      const double x = doors_[i].at.x();
      const double near = e[2] + 1.2 * side;
      const double far = e[3] - 1.2 * side;
      way.insert(way.end(), {{x, 0.0},
                             {x, e[2] + 0.6 * side},
                             {e[0] + 1.2, near},
                             {e[0] + 1.2, far},
                             {e[1] - 1.2, far},
                             {e[1] - 1.2, near},
                             {x, e[2] + 0.6 * side},
                             {x, 0.0}});
    }
    way.push_back({end_ - 1.0, 0.0});
    way.push_back({begin_ + 1.0, 0.0});
    return way;
  }

  // A shelf along the far wall, clear of its corners, and a table leg or two.
  void furnish(const Eigen::Vector4d& room) {
    const double side = room[2] > 0.0 ? 1.0 : -1.0;
    const double width = room[1] - room[0];
    const double length = draw(1.0, width - 1.2);
    const double from = room[0] + draw(0.5, width - length - 0.5);
    const double front = room[3] - side * draw(0.25, 0.45);
    addPiece({from, room[3]}, {from, front});
    addPiece({from, front}, {from + length, front});
    addPiece({from + length, front}, {from + length, room[3]});
    const Eigen::Vector2d middle(0.5 * (room[0] + room[1]), 0.5 * (room[2] + room[3]));
    for (const double x : {-0.3, 0.3}) {
      for (const double y : {-0.2, 0.2}) {
        world_.add(world::WorldDisc{{middle.x() + x, middle.y() + y}, 0.03, {}});
      }
    }
  }

  void addPiece(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    world::WorldSegment piece;
    piece.segment = {a, b};
    world_.add(piece);
  }

  std::mt19937_64 random_;
  world::RoomMap map_;
  world::World world_;
  std::vector<Door> doors_;
  std::vector<Eigen::Vector4d> extents_;  // x from, to, y from the corridor on, to
  double above_ = 0.0;
  double below_ = 0.0;
  double begin_ = 0.0;
  double end_ = 0.0;
  std::size_t corridor_ = 0;
};

}  // namespace sightline::bench
