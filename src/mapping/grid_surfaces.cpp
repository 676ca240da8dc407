#include "grid_surfaces.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace sightline::mapping {

namespace {

using dead_reckoning::SurfacePoint;

constexpr struct {
  double reach = 0.25;  // of the faces that show a direction, to either side [m]
  int least_reach = 3;  // the same in cells
  std::size_t fewest = 4;
  double roughest = 0.6;  // standard deviation of faces from their line, in cells
} kFaces{};

constexpr int kStepX[GridSurfaces::kWays] = {1, 0, -1, 0};
constexpr int kStepY[GridSurfaces::kWays] = {0, 1, 0, -1};

}  // namespace

GridSurfaces::GridSurfaces(const world::Occupancy& grid, double surface)
    : grid_(grid), surface_(surface) {}

bool GridSurfaces::isSurface(int x, int y, int way) const {
  const auto cellAt = [&](int cx, int cy) {
    const bool is_inside = cx >= 0 && cy >= 0 && cx < static_cast<int>(grid_.width) &&
                           cy < static_cast<int>(grid_.height);
    return is_inside ? grid_.cells[static_cast<std::size_t>(cy) * grid_.width +
                                   static_cast<std::size_t>(cx)]
                     : world::Occupancy::kUnknown;
  };
  return cellAt(x, y) == world::Occupancy::kOccupied &&
         cellAt(x + kStepX[way], y + kStepY[way]) == world::Occupancy::kFree;
}

Eigen::Vector2d GridSurfaces::place(int x, int y, int way) const {
  const double inwards = surface_ - 0.5;
  return grid_.resolution *
         Eigen::Vector2d(x + 0.5 - inwards * kStepX[way], y + 0.5 - inwards * kStepY[way]);
}

// A line through the faces of the same way about it, by their principal axis.
SurfacePoint GridSurfaces::at(int x, int y, int way) const {
  SurfacePoint point;
  point.position = point.smoothed = place(x, y, way);
  point.variance = grid_.resolution * grid_.resolution / 12.0;
  point.reach = 0.5 * grid_.resolution;
  const int reach =
      std::max(kFaces.least_reach, static_cast<int>(std::lround(kFaces.reach / grid_.resolution)));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double count = 0.0;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      if (!isSurface(x + i, y + j, way)) continue;
      const Eigen::Vector2d p(i, j);
      sum += p;
      squares += p * p.transpose();
      count += 1.0;
    }
  }
  if (count < static_cast<double>(kFaces.fewest)) return point;
  const Eigen::Vector2d mean = sum / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(squares / count -
                                                            mean * mean.transpose());
  if (axes.eigenvalues()[0] > kFaces.roughest * kFaces.roughest) return point;
  const Eigen::Vector2d normal = axes.eigenvectors().col(0);
  point.normal = normal.dot(Eigen::Vector2d(kStepX[way], kStepY[way])) < 0.0 ? -normal : normal;
  point.normal_variance = 1.0 / (12.0 * count * axes.eigenvalues()[1]);
  return point;
}

}  // namespace sightline::mapping
