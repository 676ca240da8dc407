#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/search_window.h"
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
  /// Index of the cell of a point, if that is so many cells inside the border.
  std::optional<std::int32_t> indexOf(const Eigen::Vector2d& point_odom, int margin) const;
  /// Sum of what the cells count, moved by (dx, dy) cells: no further than the margin they were
  /// found with.
  long sum(const std::vector<std::int32_t>& cells, int dx, int dy) const;

 private:
  Eigen::Vector2i cellOf(const Eigen::Vector2d& point_odom) const;
  void paint(const Eigen::Vector2i& centre);

  double cell_;
  int half_;  // half width of the smear [cells]
  std::vector<std::uint8_t> stamp_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  int side_;
  std::vector<std::uint8_t> cells_;
};

/// The surfaces of a submap about a place, drawn coarse and fine.
class SearchRasters {
 public:
  SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom);

  /// Tells whether they still show the submap, about a place near enough to this one.
  bool show(const Submap& submap, const Eigen::Vector2d& centre_odom) const;
  const Raster& coarse() const { return coarse_; }
  const Raster& fine() const { return fine_; }

 private:
  Raster coarse_;
  Raster fine_;
  std::uint64_t drawn_;  // version of the submap
  Eigen::Vector2d centre_odom_;
};

struct SearchCandidate {
  geometry::Pose2 T_odom_base;
  double score = 0.0;  ///< [0, 1], share of the points that lie on the reference
};

struct SearchResult {
  std::vector<SearchCandidate> candidates;  ///< best first
  std::size_t evaluations = 0;              ///< poses that were scored
};

/// Looks for a scan everywhere in a window: saarinen alg. 4, coarse to fine, with the distance to
/// the nearest neighbour looked up in rasters of the reference. Finds the best poses of the window
/// that are not neighbours of a better one. A window wider than 12 m to either side is not
/// searched beyond that.
///
/// @param rasters  drawn about the window's centre
/// @param most     candidates
SearchResult searchRasters(const std::vector<SurfacePoint>& points, const SearchRasters& rasters,
                           const SearchWindow& window, std::size_t most);

}  // namespace sightline::dead_reckoning
