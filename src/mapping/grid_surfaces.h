#pragma once

#include <cstddef>
#include <vector>

#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/world/occupancy.h"

namespace sightline::mapping {

/// Surfaces of the occupied cells of a grid, where they face cells that are not.
class GridSurfaces {
 public:
  /// Way out of a cell: +x, +y, −x, −y.
  static constexpr int kWays = 4;

  /// @param surface  where in a cell, from its open edge inwards, in cells
  GridSurfaces(const world::Occupancy& grid, double surface);

  /// Number of a cell's face; those of cells that are not occupied have no surface.
  std::size_t faceOf(int x, int y, int way) const {
    return (static_cast<std::size_t>(y) * grid_.width + static_cast<std::size_t>(x)) * kWays +
           static_cast<std::size_t>(way);
  }
  bool isSurface(int x, int y, int way) const;
  /// The surface at a face in the grid's own frame, its normal by the faces about it.
  dead_reckoning::SurfacePoint at(int x, int y, int way) const;

 private:
  Eigen::Vector2d place(int x, int y, int way) const;

  const world::Occupancy& grid_;
  double surface_;
};

}  // namespace sightline::mapping
