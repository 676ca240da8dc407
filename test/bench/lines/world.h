#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sightline/geometry/angle.h"
#include "sightline/geometry/segment.h"
#include "sightline/scan/scan.h"

/// A plane world for the benchmark of the line extractor: who hits what is known.
namespace sightline::bench {

struct Disc {
  Eigen::Vector2d centre;
  double radius;
};

struct PlaneWorld {
  std::vector<geometry::Segment> walls;
  std::vector<Disc> discs;
  int panes = 0;  ///< of glass, which send nothing back: the last walls
};

/// A ray's nearest obstacle: walls count from 0, discs follow them, −1 is nothing.
struct Hit {
  int what = -1;
  double range = std::numeric_limits<double>::infinity();
};

inline void meetWall(const geometry::Segment& wall, const Eigen::Vector2d& origin,
                     const Eigen::Vector2d& direction, int what, Hit& nearest) {
  const Eigen::Vector2d along = wall.end - wall.start;
  const Eigen::Vector2d offset = wall.start - origin;
  const double cross = direction.x() * along.y() - direction.y() * along.x();
  if (cross == 0.0) return;
  const double range = (offset.x() * along.y() - offset.y() * along.x()) / cross;
  const double share = (offset.x() * direction.y() - offset.y() * direction.x()) / cross;
  if (share < 0.0 || share > 1.0 || range <= 0.0 || range >= nearest.range) return;
  nearest = {what, range};
}

inline void meetDisc(const Disc& disc, const Eigen::Vector2d& origin,
                     const Eigen::Vector2d& direction, int what, Hit& nearest) {
  const Eigen::Vector2d offset = disc.centre - origin;
  const double closest = offset.dot(direction);
  const double square = disc.radius * disc.radius - offset.squaredNorm() + closest * closest;
  if (square < 0.0) return;
  const double range = closest - std::sqrt(square);
  if (range > 0.0 && range < nearest.range) nearest = {what, range};
}

inline Hit cast(const PlaneWorld& world, const geometry::Pose2& sensor, double angle) {
  const double heading = sensor.theta() + angle;
  const Eigen::Vector2d direction(std::cos(heading), std::sin(heading));
  Hit nearest;
  int what = 0;
  for (const auto& wall : world.walls)
    meetWall(wall, sensor.translation(), direction, what++, nearest);
  for (const Disc& disc : world.discs)
    meetDisc(disc, sensor.translation(), direction, what++, nearest);
  const auto walls = static_cast<int>(world.walls.size());
  if (nearest.what >= walls - world.panes && nearest.what < walls) {
    nearest.range = std::numeric_limits<double>::infinity();
  }
  return nearest;
}

inline void addPolygon(PlaneWorld& world, const std::vector<Eigen::Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    world.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
}

inline void addBox(PlaneWorld& world, const geometry::Pose2& pose, double length, double width) {
  const double a = 0.5 * length;
  const double b = 0.5 * width;
  addPolygon(world, {pose * Eigen::Vector2d(-a, -b), pose * Eigen::Vector2d(a, -b),
                     pose * Eigen::Vector2d(a, b), pose * Eigen::Vector2d(-a, b)});
}

inline const std::vector<Eigen::Vector2d>& boxCentres() {
  static const std::vector<Eigen::Vector2d> centres{{2.4, 1.6}, {6.3, 3.4}};
  return centres;
}

inline void addBoxes(PlaneWorld& world) {
  addBox(world, {boxCentres()[0], geometry::radians(20.0)}, 1.0, 0.7);
  addBox(world, {boxCentres()[1], 0.0}, 0.9, 0.8);
}

inline PlaneWorld roomWithBoxes() {
  PlaneWorld world;
  addPolygon(world, {{0.0, 0.0}, {8.6, 0.0}, {8.6, 5.0}, {0.0, 5.0}});
  addBoxes(world);
  return world;
}

/// The wall at x = 8.6 opens from y = 2 to 3 on a corridor that crosses behind it.
inline PlaneWorld roomWithDoor() {
  PlaneWorld world;
  addPolygon(world, {{0.0, 5.0}, {0.0, 0.0}, {8.6, 0.0}, {8.6, 2.0}});
  world.walls.pop_back();  // the chord that closes the polygon
  world.walls.push_back({{8.6, 3.0}, {8.6, 5.0}});
  world.walls.push_back({{8.6, 5.0}, {0.0, 5.0}});
  world.walls.push_back({{10.6, -4.0}, {10.6, 9.0}});
  addBoxes(world);
  return world;
}

/// Eight round legs, 5 to 20 cm in radius, anywhere half a metre from the sensor and clear of
/// walls, boxes and each other.
inline PlaneWorld roomWithLegs(const geometry::Pose2& sensor, std::mt19937& random) {
  PlaneWorld world = roomWithBoxes();
  std::uniform_real_distribution<double> radius(0.05, 0.20);
  std::uniform_real_distribution<double> x(0.0, 8.6);
  std::uniform_real_distribution<double> y(0.0, 5.0);
  constexpr double kClear = 0.3;
  const auto isClear = [&](const Disc& disc) {
    if ((disc.centre - sensor.translation()).norm() < disc.radius + 0.5) return false;
    for (const auto& wall : world.walls) {
      if (wall.distance(disc.centre) < disc.radius + kClear) return false;
    }
    for (const auto& centre : boxCentres()) {
      if ((disc.centre - centre).norm() < disc.radius + 0.6 + kClear) return false;
    }
    for (const Disc& other : world.discs) {
      if ((disc.centre - other.centre).norm() < disc.radius + other.radius + kClear) return false;
    }
    return true;
  };
  while (world.discs.size() < 8) {
    const Disc disc{{x(random), y(random)}, radius(random)};
    if (isClear(disc)) world.discs.push_back(disc);
  }
  return world;
}

/// A place for the sensor: at least 0.3 m from the walls of the room and 1.1 m from the boxes'
/// centres.
inline geometry::Pose2 randomPose(std::mt19937& random) {
  std::uniform_real_distribution<double> x(0.3, 8.3);
  std::uniform_real_distribution<double> y(0.3, 4.7);
  std::uniform_real_distribution<double> heading(-geometry::kPi, geometry::kPi);
  for (;;) {
    const Eigen::Vector2d place(x(random), y(random));
    bool clear = true;
    for (const auto& centre : boxCentres()) clear = clear && (place - centre).norm() >= 1.1;
    if (clear) return {place, heading(random)};
  }
}

}  // namespace sightline::bench
