#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "sightline/mapping/facing_images.h"

namespace sightline::mapping {

/// A rectangle along the axes of images, in cells: from the first to before the last, x and y.
struct CellBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  bool contains(const Eigen::Vector2d& p) const {
    return p.x() >= x0 && p.x() < x1 && p.y() >= y0 && p.y() < y1;
  }
  bool overlaps(const CellBox& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

/// Weights of a description of a floor by rectangles, each in metres of wall that is explained.
struct DescriptionWeights {
  double open = 0.7;          ///< of a metre of side where rays pass
  double unseen = 0.1;        ///< of a metre of side that nobody saw
  double free_area = 0.12;    ///< gained by a square metre of free floor [1/m]
  double unseen_area = 0.25;  ///< lost by a square metre that nobody saw [1/m]
  double divider = 2.0;       ///< of a metre of wall within that is seen from both sides
  double used_area = 2.0;     ///< of a square metre that is in another room [1/m]
  double room = 1.0;          ///< of a room
  double least_score = 0.5;   ///< of a room that is worth it
};

/// Worth of a rectangle as a room, in metres of wall: walls on its sides that face inwards, against
/// openings, unseen stretches, walls within, and what other rooms hold already. A look-up whatever
/// its size.
class RectangleScore {
 public:
  explicit RectangleScore(const FacingImages& images);

  /// Has to be called before anything is asked.
  void weigh(const DescriptionWeights& weights);
  const DescriptionWeights& weights() const { return weights_; }
  double of(const CellBox& box) const;
  /// Whether a room may be so small, and lies within the images with its sides.
  bool fits(const CellBox& box) const;
  /// Length of wall that faces one way, between two places of a line [m].
  double wall(int facing, int line, int from, int to) const {
    return lengths_[static_cast<std::size_t>(facing)].between(line, from, to);
  }
  /// Gives the area to a room.
  void take(const CellBox& box);
  void take(const std::function<bool(const Eigen::Vector2d&)>& holds);
  bool isUsed(int x, int y) const { return used_[cellAt(x, y)] != 0; }

 private:
  // Sums over a line of cells from its beginning, line by line.
  struct LineSums {
    std::vector<float> sums;
    int length = 0;
    double between(int line, int from, int to) const {
      const float* row =
          sums.data() + static_cast<std::size_t>(line) * (static_cast<std::size_t>(length) + 1);
      return static_cast<double>(row[to] - row[from]);
    }
  };

  void sumSides();
  double sideGain(int facing, int x, int y) const;
  void sumArea();
  double cellGain(int x, int y) const;
  bool hasTwoFaces(int facing, int x, int y) const;
  void findDividers();
  double area(const CellBox& box) const;
  std::size_t cellAt(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(images_.width()) +
           static_cast<std::size_t>(x);
  }

  const FacingImages& images_;
  DescriptionWeights weights_;
  std::array<LineSums, kFacings> sides_;    // gain of a side at a line
  std::array<LineSums, kFacings> lengths_;  // wall alone, undilated
  std::vector<double> area_;                // integral image of what the floor gains
  std::vector<std::uint8_t> used_;
  std::vector<std::uint8_t> dividers_;  // number of walls seen from both sides, by cell
};

}  // namespace sightline::mapping
