#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/geometry/segment.h"
#include "sightline/world/room_map.h"

namespace sightline::mapping {

/// The line of a side of a room: n·(p − anchor) = distance with n = (cos angle, sin angle) pointing
/// into the room; the anchor is the room's.
struct SideLine {
  double angle = 0.0;     ///< [rad]
  double distance = 0.0;  ///< [m], negative where the anchor is inside
  /// Covariance of (distance at the middle of the side, angle) [m², m rad, rad²], among the other
  /// sides: a shift and a turn of all together is no error.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  bool is_seen = false;  ///< whether scans tell where it is
  /// Standard deviation of what bends away from the line [m]: sides of a round wall are straight.
  double bend = 0.0;
  double curvature = 0.0;  ///< of the wall along the line [1/m], positive towards the room

  Eigen::Vector2d normal() const { return {std::cos(angle), std::sin(angle)}; }
};

/// A room as the lines of its sides, counter-clockwise; a corner is where two neighbours meet.
struct RoomOutline {
  std::string name;
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();  ///< in the map, about its middle [m]
  std::vector<SideLine> sides;
  std::vector<std::vector<world::Span>> spans;  ///< of each side, where it is really wall

  /// From the corner where side i begins to that where it ends, the inside on its left.
  geometry::Segment side(std::size_t i) const;
  bool contains(const Eigen::Vector2d& point_map) const;
  double area() const;  ///< [m²]
};

/// A rectangle: its middle, its turn and its size.
RoomOutline rectangleOutline(const Eigen::Vector2d& middle_map, double turn,
                             const Eigen::Vector2d& size);

/// A rectangle by its middle and turn in the map, and its size along its own axes [m].
struct Rectangle {
  geometry::Pose2 pose;
  Eigen::Vector2d size;
};

/// The rectangle that an outline is, to a centimetre; nothing where it is none.
std::optional<Rectangle> rectangleOf(const RoomOutline& room);

/// Whether neighbours are at right angles, four of them.
bool isSquare(const RoomOutline& room);

/// Whether a rooms file can hold it: its sides have lengths, and do not cross.
bool isRoom(const RoomOutline& room);

/// How well the line of a side is known: by its covariance, by how what stands there bends away
/// from it, and of a rectangle, whose sides are written as square, by the turn that this leaves
/// out.
world::WallSigma sigmaOf(const RoomOutline& room, std::size_t side);

/// The outline of a room of a map, in which neighbours meet at its corners.
RoomOutline outlineOf(const world::Room& room);

/// The outline in another frame.
RoomOutline operator*(const geometry::Pose2& T_target_source, RoomOutline room);

}  // namespace sightline::mapping
