#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/submap.h"

namespace sightline::dead_reckoning {

/// Surfaces of a submap about a place, drawn as what a point there counts: 255 on a surface and
/// less with the distance from it. There is a raster for each quarter of the directions that
/// surfaces face, and one of all for points whose surface is not known: walls of a room that is
/// turned by 90° count nothing. At level l, a cell counts the most of the 2^l by 2^l cells from it
/// on: an upper bound for all positions that differ by less than that. Cells lie on a torus, as
/// those of the submap do: what is 51 m away looks as if it were here.
class SearchRasters {
 public:
  static constexpr double kCell = 0.1;       ///< side of a cell [m]
  static constexpr std::size_t kLevels = 6;  ///< the last stands for 3.2 m
  static constexpr int kFull = 255;          ///< what a point on a surface counts

  /// A point in the cell of a raster.
  struct Cell {
    int x = 0;
    int y = 0;
    std::size_t facing = kAll;  ///< quarter of the directions, or kAll
  };
  static constexpr std::size_t kAll = 4;

  SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom);
  ~SearchRasters();
  SearchRasters(const SearchRasters&) = delete;
  SearchRasters& operator=(const SearchRasters&) = delete;

  /// Gets memory for two of them, so that no scan has to wait for it: each takes 8 MB, and where
  /// one is done with, the next one gets its memory.
  static void reserve();

  /// Tells whether they still show the submap, about a place near enough to this one.
  bool show(const Submap& submap, const Eigen::Vector2d& centre_odom) const;

  /// Cell of a place [m, odom] where a surface faces along `normal`, zero where that is not known.
  Cell cellOf(const Eigen::Vector2d& point_odom, const Eigen::Vector2d& normal) const;
  /// Sum of what points in these cells count, moved by (x, y) cells: at most, but at level 0.
  int sum(std::size_t level, const std::vector<Cell>& cells, int x, int y) const {
    const std::uint8_t* counts = raster(level, 0);
    int sum = 0;
    for (const Cell& cell : cells) {
      sum += counts[cell.facing * kSize + indexOf(cell.x + x, cell.y + y)];
    }
    return sum;
  }

 private:
  static constexpr int kSide = 512;  // of the rasters [cells], a power of two
  static constexpr std::size_t kSize = static_cast<std::size_t>(kSide) * kSide;

  static std::size_t indexOf(int x, int y) {
    return static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)));
  }
  std::uint8_t* raster(std::size_t level, std::size_t facing) const {
    return counts_.get() + (level * (kAll + 1) + facing) * kSize;
  }
  void draw(const std::vector<Surfel>& surfels);
  void draw(const Eigen::Vector2i& cell, std::size_t facing);
  Eigen::Vector2i placeOf(const Eigen::Vector2d& point_odom) const;
  static void widen(const std::uint8_t* narrow, int shift, std::uint8_t* wider);

  using Memory = std::unique_ptr<std::uint8_t[]>;
  class Store;

  Memory counts_;        // by level and direction, in one piece
  std::uint64_t drawn_;  // version of the submap
  Eigen::Vector2d centre_odom_;
  Eigen::Vector2d corner_;
};

}  // namespace sightline::dead_reckoning
