#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/world/room_map.h"

namespace sightline::world {

/// A side of a room seen from a point in front of it: all that does not depend on the ray.
class FacingSide {
 public:
  /// Point at which a ray meets the side.
  struct Meeting {
    double range = 0.0;          ///< from the eye [m]
    double along = 0.0;          ///< from the start of the segment [m]
    double cos_incidence = 1.0;  ///< of the angle between ray and normal, in (0, 1]
  };

  FacingSide(const geometry::Segment& segment, const Eigen::Vector2d& eye);

  /// Distance of the eye from the line of the side, positive on its left [m].
  double distance() const { return distance_; }
  /// Finds where a ray meets the side, coming from the left of it; nothing where it passes by, runs
  /// along it or comes from behind.
  ///
  /// @param direction  unit vector, in the frame of segment and eye
  std::optional<Meeting> meet(const Eigen::Vector2d& direction) const;

 private:
  Eigen::Vector2d normal_;
  Eigen::Vector2d direction_;
  double distance_;
  double foot_;  // of the eye's perpendicular, metres from the start
  double length_;
};

/// First thing of a map that a ray meets.
struct Sighting {
  WallIndex wall;
  double range = 0.0;          ///< [m]
  double along = 0.0;          ///< place on the wall, metres from its start
  double cos_incidence = 1.0;  ///< of the angle between ray and wall normal, in (0, 1]
  bool is_solid = false;       ///< whether a span is there
  /// Distance that the ray may be shifted before it meets another thing: distance from the ends of
  /// the span and from the jambs of the doors it passed [m], measured along the walls.
  double margin = 0.0;
};

/// View of a map from a point in one of its rooms: the room's walls from inside, and through its
/// doors the walls of the rooms behind them, and so on. A room is seen as if it stood alone but for
/// its doors: rooms that overlap do not hide each other.
///
/// Holds the map by reference.
class RoomView {
 public:
  enum class Doors {
    kOpen,    ///< rays go on in the next room
    kIgnored  ///< a door is a stretch of wall without a span
  };

  /// The eye may be anywhere; from a doorway, beyond the wall that the door pierces, the room
  /// behind it is seen too.
  RoomView(const RoomMap& map, std::size_t room, const Eigen::Vector2d& eye_map, Doors doors);

  /// First thing along a ray; nothing where the ray leaves the map. A ray that ends at the jamb of
  /// a door has a sighting of the door's wall there, which is not solid.
  ///
  /// @param direction_map  unit vector
  std::optional<Sighting> look(const Eigen::Vector2d& direction_map) const;

 private:
  // A ray on its way: the room it is in, and what it has passed.
  struct Ray {
    Eigen::Vector2d direction;
    std::size_t room = 0;
    double range = 0.0;
    double margin = 0.0;
  };
  std::optional<Sighting> first(const Ray& ray) const;
  std::optional<Ray> through(const Ray& ray, const Sighting& sighting) const;
  bool enter(const Door& door, std::size_t side, Ray& ray) const;
  std::optional<Ray> start(const Eigen::Vector2d& direction) const;
  const Door* doorwayOf() const;
  void judge(Sighting& sighting, double margin) const;

  const RoomMap& map_;
  std::size_t room_;
  Eigen::Vector2d eye_;
  Doors doors_;
  const Door* doorway_ = nullptr;
  std::vector<FacingSide> sides_;        // of the room, those seen from in front
  std::vector<std::size_t> side_walls_;  // their walls
};

}  // namespace sightline::world
