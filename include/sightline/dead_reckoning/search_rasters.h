#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/submap.h"

namespace sightline::dead_reckoning {

/// Surfaces of a submap about a place, drawn as what a point there counts: 255 on a surface and less
/// with the distance from it. Each further level has cells twice as wide, of which each counts the
/// most that any place counts from its corner up to two cells on: an upper bound for all positions
/// that differ by less than a cell.
class SearchRasters {
 public:
  static constexpr double kCell = 0.1;       ///< of level 0 [m]
  static constexpr std::size_t kLevels = 6;  ///< the last with cells of 3.2 m
  static constexpr int kFull = 255;          ///< what a point on a surface counts

  SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom);

  /// Tells whether they still show the submap, about a place near enough to this one.
  bool show(const Submap& submap, const Eigen::Vector2d& centre_odom) const;

  /// Upper bound of what a point counts at a place [m, odom], and at all places further along x
  /// and y by less than the level's cell; at level 0 the value itself. 0 outside.
  int at(std::size_t level, const Eigen::Vector2d& point_odom) const {
    const Level& cells = levels_[level];
    const Eigen::Vector2d place = (point_odom - corner_) / cells.cell;
    if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() < cells.side &&
          place.y() < cells.side)) {
      return 0;
    }
    return cells.counts[static_cast<std::size_t>(place.y()) * cells.stride +
                        static_cast<std::size_t>(place.x())];
  }

 private:
  struct Level {
    double cell = kCell;     // [m]
    double side = 0.0;       // [cells]
    std::size_t stride = 0;  // likewise
    std::vector<std::uint8_t> counts;
  };
  void draw(const std::vector<Surfel>& surfels);
  static Level halved(const Level& fine);
  static Level widened(const Level& cells);

  std::vector<Level> levels_;
  std::uint64_t drawn_;  // version of the submap
  Eigen::Vector2d centre_odom_;
  Eigen::Vector2d corner_;
};

}  // namespace sightline::dead_reckoning
