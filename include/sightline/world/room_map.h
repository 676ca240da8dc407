#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sightline/config/node.h"
#include "sightline/geometry/pose2.h"
#include "sightline/geometry/segment.h"

namespace sightline::world {

/// A room or door that cannot be. `key()` is the part of its description that is wrong, as the file
/// names it; empty where it is the whole.
class InvalidRoomMap : public std::runtime_error {
 public:
  InvalidRoomMap(std::string key, const std::string& reason)
      : std::runtime_error(reason), key_(std::move(key)) {}
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// Limits of lengths and places of a building [m]: beyond, squares overflow or vanish.
constexpr config::Range kBuildingLengths{0.001, 1e6};
constexpr config::Range kBuildingCoordinates{-1e6, 1e6};

/// A stretch of a wall, metres from the wall's start.
struct Span {
  double from = 0.0;
  double to = 0.0;
};

/// How far a wall may stand from where the map has it, as standard deviations.
struct WallSigma {
  double position = 0.0;   ///< across its middle [m]
  double direction = 0.0;  ///< about its middle [rad]
};

/// Limits of a wall's standard deviations [m, rad]: a wall that is known exactly would let no scan
/// correct it.
constexpr config::Range kWallPositionSigmas{1e-4, 10.0};
constexpr config::Range kWallDirectionSigmas{1e-5, 1.6};

/// One side of a room, in the map frame, with the inside of the room on its left.
struct Wall {
  std::string name;
  geometry::Segment segment;
  /// Stretches where the wall is really there, in order and apart; doors are left out already.
  std::vector<Span> spans;
  std::optional<WallSigma> sigma;  ///< where the map says it
};

/// A wall of a map by its place there.
struct WallIndex {
  std::size_t room = 0;
  std::size_t wall = 0;
};

/// A named room: a rectangle or a polygon, its walls counter-clockwise.
struct Room {
  std::string name;
  geometry::Pose2 T_map_room;
  std::vector<Wall> walls;
  /// Starts of the walls, in the room's own frame [m].
  std::vector<Eigen::Vector2d> corners;
  /// Whether it was described by its size, and its walls are named by compass.
  bool is_rectangle = false;

  bool contains(const Eigen::Vector2d& point_map) const;
  /// Distance to the nearest side; 0 inside.
  double distance(const Eigen::Vector2d& point_map) const;
};

/// An opening through which two rooms meet.
struct Door {
  std::size_t rooms[2] = {0, 0};  ///< indices of the rooms
  std::size_t walls[2] = {0, 0};  ///< index of the pierced wall in each of them
  Eigen::Vector2d centre_map = Eigen::Vector2d::Zero();
  double width = 0.0;     ///< [m]
  bool threshold = true;  ///< whether wheels may slip on it (jensfelt section 4.3)
};

/// Stretch of a wall that the opening of a door takes, metres from the wall's start; may reach past
/// the wall's ends.
Span openingOf(const Door& door, const Wall& wall);

/// Rooms, walls and doors of a floor: what a pose is tracked against. Built step by step, or read
/// from a file:
///
/// ```yaml
/// rooms:
///   office:
///     size: [5.0, 3.0]                 # m; a rectangle, centred on its pose
///     pose: [12.0, 4.0, 0.1]           # m, m, rad in the map; default 0; with turn_deg [x, y]
///     walls:                           # optional; others are there over their whole length
///       north: {spans: [[0.0, 2.0], [2.5, 5.0]]}   # m from the wall's start
///       east: {open: true}             # no wall at all
///       south: {sigma: [0.005, 0.001]} # m, rad: how well its line is known; default exactly
///   hall:
///     corners: [[0.0, 0.0], [4.0, 3.0]]   # m, in the map: a rectangle, by the corner at which
///                                         # its south wall starts and the one across
///     turn_deg: 12.5                      # degrees; default 0
///   tower:
///     polygon: [[0, 0], [4, 0], [3, 3], [0, 2]]    # m, in the room's frame
/// doors:
///   - {between: [office, tower], at: [14.5, 4.0], width: 0.9, threshold: true}   # m, in the map
/// ```
/// Corners and walls run counter-clockwise round the room. The walls of a rectangle are south,
/// east, north and west: those at −y, +x, +y and −x of the room's own frame. Those of a polygon are
/// 0, 1, 2, … from the corner of that number. Doors open both walls whatever their spans.
class RoomMap {
 public:
  RoomMap() = default;
  /// Throws config::Error with file, line and key.
  explicit RoomMap(const config::Node& document);
  static RoomMap readFile(const std::string& path) { return RoomMap(config::Node::readFile(path)); }

  /// Adds a room and returns its index; its walls are there over their whole length. Throws
  /// InvalidRoomMap where the name is taken, a wall has no length, walls cross, the corners do not
  /// run counter-clockwise, or a length or coordinate is not of a building.
  std::size_t addRectangle(const std::string& name, const Eigen::Vector2d& size,
                           const geometry::Pose2& T_map_room = {});
  std::size_t addPolygon(const std::string& name, const std::vector<Eigen::Vector2d>& corners_room,
                         const geometry::Pose2& T_map_room = {});
  /// Says where a wall is really there; none where it is open. To be said before the doors. Throws
  /// InvalidRoomMap, with the number of the span as its key, where one is no stretch of the wall
  /// or overlaps the one before it.
  void setSpans(const WallIndex& wall, const std::vector<Span>& spans);
  /// Says how well a wall is known. Throws InvalidRoomMap where it is out of range.
  void setSigma(const WallIndex& wall, const WallSigma& sigma);
  /// Opens the walls of both rooms that are nearest to the centre. Throws InvalidRoomMap where the
  /// rooms are one, or no wall of either is there for it.
  ///
  /// @param centre_map  [m]
  /// @param width       [m]
  void addDoor(std::size_t room, std::size_t other, const Eigen::Vector2d& centre_map, double width,
               bool threshold = true);

  const std::vector<Room>& rooms() const { return rooms_; }
  const std::vector<Door>& doors() const { return doors_; }
  const Wall& wall(const WallIndex& index) const { return rooms_[index.room].walls[index.wall]; }
  std::optional<std::size_t> find(const std::string& name) const;
  /// The room that holds a point; where rooms overlap, `preferred` wins.
  std::optional<std::size_t> roomAt(const Eigen::Vector2d& point_map,
                                    std::optional<std::size_t> preferred = std::nullopt) const;
  /// The room nearest to a point. The map has to hold one.
  std::size_t nearestRoom(const Eigen::Vector2d& point_map) const;
  /// The door between two rooms that is nearest to a point.
  const Door* doorBetween(std::size_t a, std::size_t b, const Eigen::Vector2d& near_map) const;

 private:
  Wall& wallAt(const WallIndex& index);
  std::size_t add(Room room, const std::vector<std::string>& wall_names);
  std::size_t pierce(const Door& door, std::size_t room) const;

  std::vector<Room> rooms_;
  std::vector<Door> doors_;
};

}  // namespace sightline::world
