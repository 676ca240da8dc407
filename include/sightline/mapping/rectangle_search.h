#pragma once

#include <array>
#include <cstddef>
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

/// Finds rooms as rectangles: the fewest that explain the walls seen from inside, by a score that
/// weighs walls on the sides against openings, floor within, walls within, and the number of rooms.
class RectangleSearch {
 public:
  explicit RectangleSearch(const FacingImages& images);

  /// Rooms that together hold as many of the places as is worth it, best first.
  ///
  /// @param places  of the path, in cells
  std::vector<CellBox> find(const std::vector<Eigen::Vector2d>& places);

 private:
  struct Candidate {
    CellBox box;
    double score;
  };
  // Cells of a side: wall on it; wall beyond it, of that near its first and last cell.
  struct Beyond {
    int inner = 0;
    int outer = 0;
    int first = 0;
    int last = 0;
  };
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
  void findDividers();
  bool hasTwoFaces(int facing, int x, int y) const;
  double score(const CellBox& box) const;
  double area(const CellBox& box) const;
  bool fits(const CellBox& box) const;
  std::vector<int> sidesOf(int facing, int x, int y) const;
  Candidate best(const Eigen::Vector2d& place) const;
  void climb(Candidate& candidate, const Eigen::Vector2d& place) const;
  bool moveSide(Candidate& candidate, int side, const Eigen::Vector2d& place) const;
  Candidate split(const Candidate& whole, const Eigen::Vector2d& place) const;
  void take(const CellBox& box);
  Beyond lookBeyond(const CellBox& box, int side, int far) const;
  void pushOut(CellBox& box, int side) const;
  std::size_t cellAt(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(images_.width()) +
           static_cast<std::size_t>(x);
  }
  void searchFrom(std::vector<Eigen::Vector2d>& places, std::vector<CellBox>& rooms);

  const FacingImages& images_;
  DescriptionWeights weights_;
  std::array<LineSums, kFacings> sides_;    // gain of a side at a line
  std::array<LineSums, kFacings> lengths_;  // wall alone, undilated
  std::vector<double> area_;                // integral image of what the floor gains
  std::vector<std::uint8_t> used_;
  std::vector<std::uint8_t> dividers_;  // number of walls seen from both sides, by cell
};

}  // namespace sightline::mapping
