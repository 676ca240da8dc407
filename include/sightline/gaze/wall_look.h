#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/world/room_view.h"

namespace sightline::gaze {

/// Beam of a scan, and the wall that it meets by the map.
struct MappedBeam {
  world::Sighting sighting;
  double variance = 0.0;    ///< of the range, and of all beams that this one stands for [m²]
  bool meets_wall = false;  ///< whether the range is that of the wall
};

/// Beams of a scan that look at a wall of the map within reach, from a sensor at a pose in a room.
std::vector<MappedBeam> mapBeams(const scan::Scan& scan, const world::RoomMap& map,
                                 std::size_t room, const geometry::Pose2& T_map_sensor);

/// What beams say of the line of one wall: of the offset of its middle along the normal [m] and its
/// turn about the middle [rad].
struct WallLook {
  world::WallIndex wall;
  Eigen::Vector2d middle;  ///< in the map [m]
  Eigen::Vector2d normal;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  double from = 1e9, to = -1e9;  ///< stretch of the wall in view, along it [m]
};

/// Gathers beams by the walls that they meet.
class WallLooks {
 public:
  explicit WallLooks(const world::RoomMap& map) : map_(&map) {}

  /// A beam that meets a wall, with a range of such an inverse variance [1/m²].
  void add(const world::Sighting& sighting, double weight);
  const std::vector<WallLook>& all() const { return looks_; }
  void clear() { looks_.clear(); }

 private:
  WallLook& of(const world::WallIndex& wall);

  const world::RoomMap* map_;
  std::vector<WallLook> looks_;
};

}  // namespace sightline::gaze
