#pragma once

#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/tracking/surface_points.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Moves a scan onto the walls of a map: Gauss-Newton on the distances of its points from the walls
/// that face them, position and heading together, far points losing weight.
class WallAlignment {
 public:
  /// @param points  in the sensor's frame; held by reference
  WallAlignment(const world::RoomMap& map, const std::vector<SurfacePoint>& points);

  /// The pose near `T_map_sensor` at which the points lie best on the walls of a room and of those
  /// behind its doors.
  geometry::Pose2 refine(const geometry::Pose2& T_map_sensor, std::size_t room) const;

 private:
  struct Piece {
    Eigen::Vector2d start;
    Eigen::Vector2d normal;
    double length;
  };

  const Piece* nearest(const std::vector<Piece>& pieces, const Eigen::Vector2d& position_map,
                       const Eigen::Vector2d& normal_map, double reach) const;

  const std::vector<SurfacePoint>& points_;
  std::vector<std::vector<Piece>> pieces_;  // by room
};

}  // namespace sightline::tracking
