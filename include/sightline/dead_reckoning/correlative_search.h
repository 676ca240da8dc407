#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/submap.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// A raster of surfaces, smeared: what a point at a place counts, 255 on a surface and less with
/// the distance from it.
class Raster {
 public:
  /// @param cell   side of a cell [m]
  /// @param smear  distance from which on a point counts nothing [m]
  Raster(double cell, double smear);

  void draw(const std::vector<Surfel>& surfels, const Eigen::Vector2d& centre_odom);
  double cell() const { return cell_; }
  /// Of the cell of a point, if that is so many cells inside the border.
  std::optional<std::int32_t> indexOf(const Eigen::Vector2d& point_odom, int margin) const;
  /// Of what the cells count, moved by (dx, dy) cells: no further than the margin they were found
  /// with.
  long sum(const std::vector<std::int32_t>& cells, int dx, int dy) const;

 private:
  Eigen::Vector2i cellOf(const Eigen::Vector2d& point_odom) const;
  void paint(const Eigen::Vector2i& centre);

  double cell_;
  int half_;  // of the smear, in cells
  std::vector<std::uint8_t> stamp_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  int side_;
  std::vector<std::uint8_t> cells_;
};

/// Poses of the base within these distances of a centre.
struct SearchWindow {
  geometry::Pose2 centre;  ///< T_odom_base
  double position = 0.0;   ///< half side of the square, along the axes of odom [m]
  double heading = 0.0;    ///< half width [rad]
};

struct SearchCandidate {
  geometry::Pose2 T_odom_base;
  double score = 0.0;  ///< [0, 1], share of the points that lie on the reference
};

/// Looks for a scan everywhere in a window: saarinen alg. 4, coarse to fine, with the distance to
/// the nearest neighbour looked up in rasters of the reference.
class CorrelativeSearch {
 public:
  /// The best poses of the window that are not neighbours of a better one, best first.
  std::vector<SearchCandidate> search(const std::vector<SurfacePoint>& points, const Submap& submap,
                                      const SearchWindow& window, std::size_t most);

 private:
  void draw(const Submap& submap, const Eigen::Vector2d& centre_odom);

  Raster coarse_{0.4, 0.6};
  Raster fine_{0.1, 0.25};
  std::uint64_t drawn_ = 0;  // version of the submap
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
};

}  // namespace sightline::dead_reckoning
