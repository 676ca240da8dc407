#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "sightline/mapping/rectangle_score.h"

namespace sightline::mapping {

/// Finds rooms as rectangles: the fewest that explain the walls seen from inside, by a score that
/// weighs walls on the sides against openings, floor within, walls within, and the number of rooms.
/// Goes step by step, so that searches along several directions can take turns.
class RectangleSearch {
 public:
  /// Number of rounds; later ones are laxer about what clear rooms have left over.
  static constexpr int kRounds = 3;

  /// Holds the images by reference.
  ///
  /// @param places  of the path, in cells, that want a room
  RectangleSearch(const FacingImages& images, std::vector<Eigen::Vector2d> places)
      : images_(images), score_(images), places_(std::move(places)) {}

  /// Begins a round, with the places that no room holds yet.
  void begin(int round);
  /// Score of the best room there is; nothing where none is worth it.
  std::optional<double> bestScore();
  /// Takes that room; its places are done.
  CellBox takeBest();
  /// Gives floor to a room that was found otherwise; `holds` tells of a place in cells.
  void giveAway(const std::function<bool(const Eigen::Vector2d&)>& holds);
  /// Moves sides that lie on furniture out to the wall beyond. To be called when all rooms are
  /// found.
  void pushOut(CellBox& box) const;

 private:
  struct Candidate {
    CellBox box;
    double score;
  };
  struct Seed {
    Eigen::Vector2d place;
    Candidate best;
    bool is_known = false;
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
  std::vector<Seed>::iterator leader();
  void leave(const std::function<bool(const Eigen::Vector2d&)>& holds);

  const FacingImages& images_;
  RectangleScore score_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<Seed> seeds_;
};

}  // namespace sightline::mapping
