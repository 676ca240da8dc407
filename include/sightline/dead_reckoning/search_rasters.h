#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/submap.h"

namespace sightline::dead_reckoning {

/// Surfaces of a submap about a place, drawn as what a point there counts: 255 on a surface and less
/// with the distance from it. At level l, a cell counts the most of the 2^l by 2^l cells from it on:
/// an upper bound for all positions that differ by less than that.
class SearchRasters {
 public:
  static constexpr double kCell = 0.1;       ///< side of a cell [m]
  static constexpr std::size_t kLevels = 6;  ///< the last stands for 3.2 m
  static constexpr int kFull = 255;          ///< what a point on a surface counts

  SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom);

  /// Tells whether they still show the submap, about a place near enough to this one.
  bool show(const Submap& submap, const Eigen::Vector2d& centre_odom) const;

  /// What a point counts at a place [m, odom], at most; 0 outside.
  int at(std::size_t level, const Eigen::Vector2d& point_odom) const {
    const Eigen::Vector2d place = (point_odom - corner_) / kCell;
    if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() < kSide && place.y() < kSide)) return 0;
    return levels_[level][static_cast<std::size_t>(place.y()) * kSide +
                          static_cast<std::size_t>(place.x())];
  }

 private:
  static constexpr std::size_t kSide = 512;  // of the rasters [cells]
  using Raster = std::vector<std::uint8_t>;

  void draw(const std::vector<Surfel>& surfels);
  static Raster widened(const Raster& raster, std::size_t shift);

  std::array<Raster, kLevels> levels_;
  std::uint64_t drawn_;  // version of the submap
  Eigen::Vector2d centre_odom_;
  Eigen::Vector2d corner_;
};

}  // namespace sightline::dead_reckoning
