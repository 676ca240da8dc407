#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "world.h"

/// Worlds unlike the room that the extractor was built on, each with a place for the sensor. Every
/// call draws another world.
namespace sightline::bench {

struct Scene {
  PlaneWorld world;
  geometry::Pose2 pose;
};

inline double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Nothing is nearer to the place than this.
inline bool isClear(const PlaneWorld& world, const Eigen::Vector2d& place, double distance) {
  for (const auto& wall : world.walls) {
    if (wall.distance(place) < distance) return false;
  }
  return std::all_of(world.discs.begin(), world.discs.end(), [&](const Disc& disc) {
    return (disc.centre - place).norm() > disc.radius + distance;
  });
}

/// A ray to the left crosses the walls of a closed outline an odd number of times from inside.
inline bool isInside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& place) {
  bool inside = false;
  for (std::size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[k];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    if (place.x() < a.x() + (b.x() - a.x()) * (place.y() - a.y()) / (b.y() - a.y())) {
      inside = !inside;
    }
  }
  return inside;
}

/// Draws a place inside the outline with so much space around it, where there is.
inline Eigen::Vector2d placeIn(const PlaneWorld& world, const std::vector<Eigen::Vector2d>& outline,
                               double space, std::mt19937& random) {
  Eigen::Vector2d low = outline.front();
  Eigen::Vector2d high = outline.front();
  for (const auto& corner : outline) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  for (;;) {
    const Eigen::Vector2d place(uniform(random, low.x(), high.x()),
                                uniform(random, low.y(), high.y()));
    if (isInside(outline, place) && isClear(world, place, space)) return place;
    space *= 0.999;  // a full room makes do with less
  }
}

inline Scene seenFromInside(PlaneWorld world, const std::vector<Eigen::Vector2d>& outline,
                            std::mt19937& random) {
  const Eigen::Vector2d place = placeIn(world, outline, 0.4, random);
  return {std::move(world), {place, uniform(random, -geometry::kPi, geometry::kPi)}};
}

inline void addBoxesWithin(PlaneWorld& world, const std::vector<Eigen::Vector2d>& outline,
                           int count, std::mt19937& random) {
  for (int i = 0; i < count; ++i) {
    const double length = uniform(random, 0.6, 1.4);
    const double width = uniform(random, 0.5, 0.9);
    const double space = 0.3 + 0.5 * std::hypot(length, width);
    const Eigen::Vector2d centre = placeIn(world, outline, space, random);
    addBox(world, {centre, uniform(random, -geometry::kPi, geometry::kPi)}, length, width);
  }
}

/// An L of walls at right angles, with four boxes.
inline Scene lRoom(std::mt19937& random) {
  const double x = uniform(random, 3.0, 5.0);
  const double y = uniform(random, 2.5, 4.0);
  const std::vector<Eigen::Vector2d> outline{{0.0, 0.0}, {x + 3.5, 0.0}, {x + 3.5, y},
                                             {x, y},     {x, y + 3.0},   {0.0, y + 3.0}};
  PlaneWorld world;
  addPolygon(world, outline);
  addBoxesWithin(world, outline, 4, random);
  return seenFromInside(std::move(world), outline, random);
}

/// Four legs of square tubes.
inline void addChair(PlaneWorld& world, const geometry::Pose2& pose) {
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.2, 0.2}) {
      addBox(world, {pose * Eigen::Vector2d(x, y), pose.theta()}, 0.03, 0.03);
    }
  }
}

/// An L whose walls stand at odd angles, with desks, and chairs of which only legs are seen.
inline Scene office(std::mt19937& random) {
  std::vector<Eigen::Vector2d> outline{{0.0, 0.0}, {9.0, 0.0}, {9.0, 4.5},
                                       {5.0, 4.5}, {5.0, 8.0}, {0.0, 8.0}};
  for (auto& corner : outline) {
    corner += Eigen::Vector2d(uniform(random, -0.6, 0.6), uniform(random, -0.6, 0.6));
  }
  PlaneWorld world;
  addPolygon(world, outline);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector2d desk = placeIn(world, outline, 0.9, random);
    addBox(world, {desk, uniform(random, -geometry::kPi, geometry::kPi)}, uniform(random, 1.0, 1.5),
           uniform(random, 0.5, 0.7));
  }
  for (int i = 0; i < 7; ++i) {
    const Eigen::Vector2d chair = placeIn(world, outline, 0.4, random);
    addChair(world, {chair, uniform(random, -geometry::kPi, geometry::kPi)});
  }
  return seenFromInside(std::move(world), outline, random);
}

/// One side of the corridor: panels with recessed doors between them, from left to right.
inline void addSide(PlaneWorld& world, double length, double y, double recess, double first_door) {
  constexpr double kDoor = 0.9;
  double from = 0.0;
  for (double door = first_door; door + kDoor < length; door += 4.0) {
    world.walls.push_back({{from, y}, {door, y}});
    world.walls.push_back({{door, y}, {door, y + recess}});
    world.walls.push_back({{door, y + recess}, {door + kDoor, y + recess}});
    world.walls.push_back({{door + kDoor, y + recess}, {door + kDoor, y}});
    from = door + kDoor;
  }
  world.walls.push_back({{from, y}, {length, y}});
}

/// 60 m by 2.4 m, with a recessed door every 4 m on either side, and square pillars.
inline Scene corridor(std::mt19937& random) {
  constexpr double kLength = 60.0;
  constexpr double kWidth = 2.4;
  PlaneWorld world;
  addSide(world, kLength, 0.0, -0.25, uniform(random, 0.5, 4.0));
  addSide(world, kLength, kWidth, 0.25, uniform(random, 0.5, 4.0));
  world.walls.push_back({{0.0, 0.0}, {0.0, kWidth}});
  world.walls.push_back({{kLength, 0.0}, {kLength, kWidth}});
  for (double x = uniform(random, 2.0, 9.0); x < kLength - 1.0; x += uniform(random, 6.0, 12.0)) {
    const double y = uniform(random, 0.0, 1.0) < 0.5 ? 0.35 : kWidth - 0.35;
    addBox(world, {Eigen::Vector2d(x, y), 0.0}, 0.3, 0.3);
  }
  const std::vector<Eigen::Vector2d> outline{
      {0.0, 0.0}, {kLength, 0.0}, {kLength, kWidth}, {0.0, kWidth}};
  return seenFromInside(std::move(world), outline, random);
}

/// A wall from one corner to another with a pane of glass of two metres in it; the pane comes back.
inline geometry::Segment addWallWithPane(PlaneWorld& world, const Eigen::Vector2d& from,
                                         const Eigen::Vector2d& to, std::mt19937& random) {
  const geometry::Segment whole{from, to};
  const double at = uniform(random, 2.0, whole.length() - 4.0);
  const Eigen::Vector2d first = whole.start + at * whole.direction();
  const Eigen::Vector2d second = first + 2.0 * whole.direction();
  world.walls.push_back({from, first});
  world.walls.push_back({second, to});
  return {first, second};
}

/// A large room with round columns, and panes that return nothing.
inline Scene hall(std::mt19937& random) {
  const double x = uniform(random, 14.0, 22.0);
  const double y = uniform(random, 10.0, 15.0);
  const std::vector<Eigen::Vector2d> outline{{0.0, 0.0}, {x, 0.0}, {x, y}, {0.0, y}};
  PlaneWorld world;
  std::vector<geometry::Segment> panes;
  panes.push_back(addWallWithPane(world, outline[0], outline[1], random));
  world.walls.push_back({outline[1], outline[2]});
  panes.push_back(addWallWithPane(world, outline[2], outline[3], random));
  world.walls.push_back({outline[3], outline[0]});
  world.walls.insert(world.walls.end(), panes.begin(), panes.end());
  world.panes = static_cast<int>(panes.size());
  for (int i = 0; i < 6; ++i) {
    const double radius = uniform(random, 0.2, 0.35);
    world.discs.push_back({placeIn(world, outline, radius + 0.8, random), radius});
  }
  return seenFromInside(std::move(world), outline, random);
}

/// A room of many walls that meet at 150 to 170 degrees: nearly a circle.
inline Scene obtuseRoom(std::mt19937& random) {
  std::vector<double> normals;
  double turned = 0.0;
  while (turned < 2.0 * geometry::kPi) {
    normals.push_back(turned);
    turned += uniform(random, geometry::radians(10.0), geometry::radians(30.0));
  }
  // The last corner takes what is left, which must be of that size, too.
  const double rest = 2.0 * geometry::kPi - normals.back();
  if (rest < geometry::radians(10.0) || rest > geometry::radians(30.0)) return obtuseRoom(random);
  const double radius = uniform(random, 3.0, 6.0);
  std::vector<Eigen::Vector2d> outline;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double a = normals[i];
    const double b = normals[(i + 1) % normals.size()];
    const double half = 0.5 * geometry::wrapAngle(b - a);
    outline.push_back(radius / std::cos(half) *
                      Eigen::Vector2d(std::cos(a + half), std::sin(a + half)));
  }
  PlaneWorld world;
  addPolygon(world, outline);
  return seenFromInside(std::move(world), outline, random);
}

}  // namespace sightline::bench
