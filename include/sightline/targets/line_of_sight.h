#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/world/occupancy.h"
#include "sightline/world/world.h"

namespace sightline::targets {

/// Whether something stands between two points of the map.
class LineOfSight {
 public:
  virtual ~LineOfSight() = default;
  virtual bool isClear(const Eigen::Vector2d& from_map, const Eigen::Vector2d& to_map) const = 0;
};

/// Sight at a height [m] above the floor of a world of walls and furniture. A surface within
/// `tolerance` [m] of the far end does not hide it: the target may be that surface.
class WorldSight : public LineOfSight {
 public:
  WorldSight(world::World world, double height, double tolerance = 0.1)
      : world_(std::move(world)), height_(height), tolerance_(tolerance) {}
  bool isClear(const Eigen::Vector2d& from_map, const Eigen::Vector2d& to_map) const override;

 private:
  world::World world_;
  double height_;
  double tolerance_;
};

/// Sight in the world of a file at a height [m]; none where the path is empty. Throws
/// config::Error.
std::shared_ptr<const LineOfSight> worldSight(const std::string& path, double height);

/// Sight over the cells of a grid, which lies at `T_map_grid`: occupied ones stop it, up to
/// `tolerance` [m] before the far end.
class GridSight : public LineOfSight {
 public:
  explicit GridSight(world::Occupancy grid, const geometry::Pose2& T_map_grid = {},
                     double tolerance = 0.1)
      : grid_(std::move(grid)), T_grid_map_(T_map_grid.inverse()), tolerance_(tolerance) {}
  bool isClear(const Eigen::Vector2d& from_map, const Eigen::Vector2d& to_map) const override;

 private:
  world::Occupancy grid_;
  geometry::Pose2 T_grid_map_;
  double tolerance_;
};

}  // namespace sightline::targets
