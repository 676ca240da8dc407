#pragma once

#include <vector>

#include <Eigen/Core>

#include "sightline/mapping/rectangle_score.h"

namespace sightline::mapping {

/// Finds rooms as rectangles: the fewest that explain the walls seen from inside, by a score that
/// weighs walls on the sides against openings, floor within, walls within, and the number of rooms.
class RectangleSearch {
 public:
  /// Holds the images by reference.
  explicit RectangleSearch(const FacingImages& images) : images_(images), score_(images) {}

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

  std::vector<int> sidesOf(int facing, int x, int y) const;
  Candidate best(const Eigen::Vector2d& place) const;
  void climb(Candidate& candidate, const Eigen::Vector2d& place) const;
  bool moveSide(Candidate& candidate, int side, const Eigen::Vector2d& place) const;
  Candidate split(const Candidate& whole, const Eigen::Vector2d& place) const;
  Beyond lookBeyond(const CellBox& box, int side, int far) const;
  void pushOut(CellBox& box, int side) const;
  void searchFrom(std::vector<Eigen::Vector2d>& places, std::vector<CellBox>& rooms);

  const FacingImages& images_;
  RectangleScore score_;
};

}  // namespace sightline::mapping
