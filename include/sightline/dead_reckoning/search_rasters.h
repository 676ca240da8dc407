#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/submap.h"

namespace sightline::dead_reckoning {

/// Surfaces of a submap about a place, drawn as what a point there counts: 255 on a surface and
/// less with the distance from it. At level l, a cell counts the most of the 2^l by 2^l cells from
/// it on: an upper bound for all positions that differ by less than that. Cells lie on a torus, as
/// those of the submap do: what is 51 m away looks as if it were here.
class SearchRasters {
 public:
  static constexpr double kCell = 0.1;       ///< side of a cell [m]
  static constexpr std::size_t kLevels = 6;  ///< the last stands for 3.2 m
  static constexpr int kFull = 255;          ///< what a point on a surface counts

  SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom);

  /// Tells whether they still show the submap, about a place near enough to this one.
  bool show(const Submap& submap, const Eigen::Vector2d& centre_odom) const;

  /// Cell of a place [m, odom].
  Eigen::Vector2i cellOf(const Eigen::Vector2d& point_odom) const {
    return ((point_odom - corner_) / kCell).array().floor().max(-1e6).min(1e6).cast<int>().matrix();
  }
  /// Sum of what points in these cells count, moved by (x, y) cells: at most, but at level 0.
  int sum(std::size_t level, const std::vector<Eigen::Vector2i>& cells, int x, int y) const {
    const std::uint8_t* counts = levels_[level].data();
    int sum = 0;
    for (const Eigen::Vector2i& cell : cells) sum += counts[indexOf(cell.x() + x, cell.y() + y)];
    return sum;
  }

 private:
  static constexpr int kSide = 512;  // of the rasters [cells], a power of two
  using Raster = std::vector<std::uint8_t>;

  static std::size_t indexOf(int x, int y) {
    return static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)));
  }
  void draw(const std::vector<Surfel>& surfels);
  static Raster widened(const Raster& raster, int shift);

  std::array<Raster, kLevels> levels_;
  std::uint64_t drawn_;  // version of the submap
  Eigen::Vector2d centre_odom_;
  Eigen::Vector2d corner_;
};

}  // namespace sightline::dead_reckoning
