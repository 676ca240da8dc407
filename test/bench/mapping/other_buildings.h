#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bench/rooms/recorded_drive.h"
#include "sightline/world/world.h"

namespace sightline::bench {

/// A building that is not made of rectangles alone, and a drive through it; odometry 2 % short.
struct OtherBuilding {
  std::string name;
  DriveSetup setup;
};

/// Draws such buildings wall by wall.
class BuildingDrawer {
 public:
  using Point = Eigen::Vector2d;

  void wall(const Point& a, const Point& b) {
    world::WorldSegment wall;
    wall.segment = {a, b};
    setup_.world.add(wall);
  }
  void walls(const std::vector<Point>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) wall(points[i - 1], points[i]);
  }
  /// An arc in pieces of 2 degrees.
  void arc(const Point& centre, double radius, double from_deg, double to_deg) {
    const int pieces = std::max(1, static_cast<int>(std::ceil((to_deg - from_deg) / 2.0)));
    const auto at = [&](int i) {
      const double angle = geometry::radians(from_deg + (to_deg - from_deg) * i / pieces);
      return Point(centre + radius * Point(std::cos(angle), std::sin(angle)));
    };
    for (int i = 0; i < pieces; ++i) wall(at(i), at(i + 1));
  }
  /// A wall with niches as deep as a door frame, 4 to 9 m apart.
  void corridorWall(const Point& from, const Point& to, std::mt19937_64& random) {
    const auto draw = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const Point along = (to - from).normalized();
    const Point outwards(along.y(), -along.x());
    Point last = from;
    for (double at = draw(1.0, 5.0); at + 2.0 < (to - from).norm(); at += draw(4.0, 9.0)) {
      const Point begin = from + at * along;
      const Point deep = draw(0.08, 0.3) * outwards;
      const Point end = begin + 0.9 * along;
      walls({last, begin, begin + deep, end + deep, end});
      last = end;
    }
    wall(last, to);
  }

  OtherBuilding finish(const std::string& name, const geometry::Pose2& start,
                       std::vector<Point> way, int beams, double range) {
    setup_.start = start;
    setup_.path.speed = 0.5;
    setup_.path.turn_rate = 0.8;
    setup_.path.tolerance = 0.2;
    Point before = start.translation();
    for (const Point& point : way) {
      setup_.seconds += (point - before).norm() / setup_.path.speed + 5.0;
      before = point;
    }
    setup_.path.waypoints_map = std::move(way);
    setup_.scanner.beams = static_cast<std::size_t>(beams);
    setup_.scanner.angle_min = -0.5 * geometry::kPi;
    setup_.scanner.angle_max = 0.5 * geometry::kPi;
    setup_.scanner.range_max = range;
    setup_.scanner.rate = 5.0;
    setup_.scanner.noise.sigma = 0.01;
    setup_.height = 0.4;
    setup_.robot.odometry.scale_mean = 1.02;
    setup_.robot.odometry.scale_sigma = 0.0;
    return {name, setup_};
  }

 private:
  DriveSetup setup_;
};

/// A round hall of 10 m across; a room behind a door in the round wall, and a corridor that opens
/// into it.
inline OtherBuilding roundHall() {
  BuildingDrawer draw;
  draw.arc({0.0, 0.0}, 5.0, 6.0, 78.5);
  draw.arc({0.0, 0.0}, 5.0, 101.5, 354.0);
  draw.walls({{4.97, 0.52},
              {5.2, 0.52},
              {5.2, 2.5},
              {10.2, 2.5},
              {10.2, -2.0},
              {5.2, -2.0},
              {5.2, -0.52},
              {4.97, -0.52}});
  draw.walls({{1.0, 4.9}, {1.0, 14.0}, {-1.0, 14.0}, {-1.0, 4.9}});
  return draw.finish("round_hall", {-3.0, -2.0, 0.0},
                     {{2.5, -2.5},
                      {3.0, 0.0},
                      {6.5, 0.0},
                      {9.0, 1.0},
                      {8.5, -1.0},
                      {6.0, 0.0},
                      {3.0, 0.0},
                      {2.0, 2.5},
                      {0.0, 3.0},
                      {0.0, 12.5},
                      {0.0, 3.0},
                      {-2.5, 2.0},
                      {-3.0, -2.0},
                      {2.5, -2.5}},
                     361, 20.0);
}

/// A room with a bay of three windows and an apse, another behind a door.
inline OtherBuilding bayRoom() {
  BuildingDrawer draw;
  draw.walls({{0.0, 5.0},
              {0.0, 0.0},
              {1.2, 0.0},
              {2.2, -1.4},
              {4.2, -1.4},
              {5.2, 0.0},
              {7.0, 0.0},
              {7.0, 0.6}});
  draw.arc({7.0, 2.5}, 1.9, -90.0, 90.0);
  draw.walls({{7.0, 4.4},
              {7.0, 5.0},
              {3.9, 5.0},
              {3.9, 5.14},
              {6.0, 5.14},
              {6.0, 9.0},
              {1.0, 9.0},
              {1.0, 5.14},
              {3.0, 5.14},
              {3.0, 5.0},
              {0.0, 5.0}});
  return draw.finish("bay", {1.0, 1.0, 0.0},
                     {{3.2, 0.5},
                      {3.2, -0.4},
                      {4.0, 1.0},
                      {7.0, 2.0},
                      {7.5, 3.0},
                      {5.5, 3.5},
                      {3.45, 4.0},
                      {3.45, 6.0},
                      {4.8, 7.5},
                      {2.2, 7.5},
                      {3.45, 6.0},
                      {3.45, 4.0},
                      {1.0, 3.5},
                      {1.0, 1.0}},
                     361, 20.0);
}

/// An L of a room with an oblique wall across its corner, no side of which is along another.
inline OtherBuilding obliqueRoom() {
  BuildingDrawer draw;
  draw.walls({{0.0, 0.0}, {7.0, 0.0}, {8.5, 3.0}, {6.0, 6.5}, {2.0, 7.0}, {-1.5, 4.0}, {0.0, 0.0}});
  return draw.finish(
      "oblique", {1.0, 1.5, 0.0},
      {{6.0, 1.5}, {6.8, 3.0}, {5.0, 5.0}, {2.0, 5.5}, {0.5, 4.0}, {1.0, 1.5}, {6.0, 1.5}}, 361,
      20.0);
}

/// A corridor of 70 m with door niches and a room at each end, seen with beams of a degree.
inline OtherBuilding longCorridor(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  BuildingDrawer draw;
  draw.corridorWall({0.0, -1.1}, {70.0, -1.1}, random);
  draw.corridorWall({70.0, 1.1}, {0.0, 1.1}, random);
  draw.walls({{0.0, 1.1},
              {0.0, 0.45},
              {-0.14, 0.45},
              {-0.14, 2.5},
              {-5.0, 2.5},
              {-5.0, -2.0},
              {-0.14, -2.0},
              {-0.14, -0.45},
              {0.0, -0.45},
              {0.0, -1.1}});
  draw.walls({{70.0, -1.1},
              {70.0, -0.45},
              {70.14, -0.45},
              {70.14, -3.0},
              {76.0, -3.0},
              {76.0, 2.0},
              {70.14, 2.0},
              {70.14, 0.45},
              {70.0, 0.45},
              {70.0, 1.1}});
  return draw.finish("long_corridor", {-3.5, -0.8, 0.0},
                     {{-1.5, 0.0},
                      {35.0, 0.1},
                      {71.5, 0.0},
                      {74.5, -1.5},
                      {74.5, 0.8},
                      {71.5, 0.0},
                      {35.0, -0.1},
                      {-1.5, 0.0},
                      {-3.5, 1.0}},
                     181, 20.0);
}

/// A corridor bent along half a circle of 15 m, with a room at either end.
inline OtherBuilding bentCorridor() {
  BuildingDrawer draw;
  draw.arc({0.0, 0.0}, 13.9, 0.0, 180.0);
  draw.arc({0.0, 0.0}, 16.1, 0.0, 180.0);
  draw.walls({{13.9, 0.0}, {12.0, 0.0}, {12.0, -5.0}, {18.0, -5.0}, {18.0, 0.0}, {16.1, 0.0}});
  draw.walls(
      {{-16.1, 0.0}, {-18.0, 0.0}, {-18.0, -4.0}, {-13.0, -4.0}, {-13.0, 0.0}, {-13.9, 0.0}});
  std::vector<Eigen::Vector2d> way = {{15.0, -1.0}};
  const auto along = [&](double deg) {
    way.emplace_back(15.0 * std::cos(geometry::radians(deg)),
                     15.0 * std::sin(geometry::radians(deg)));
  };
  for (double deg = 8.0; deg < 180.0; deg += 12.0) along(deg);
  way.insert(way.end(), {{-15.0, -1.0}, {-16.5, -2.5}, {-15.0, -1.0}});
  for (double deg = 176.0; deg > 0.0; deg -= 12.0) along(deg);
  way.insert(way.end(), {{15.0, -1.0}, {13.5, -3.5}});
  return draw.finish("bent_corridor", {13.5, -3.5, 0.0}, way, 361, 20.0);
}

}  // namespace sightline::bench
