#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/line_sums.h"
#include "sightline/lines/piece.h"

namespace sightline::lines {

/// Divides pieces that several lines explain better than one.
///
/// The filter bends along with a wall that turns by little, as each return is within the gate of
/// what went before. The returns of a finished piece are gathered in blocks, and the division of
/// the blocks into lines that is likeliest is found by dynamic programming over their prefix sums;
/// every line but the first costs what chance may gain by one.
class Splitting {
 public:
  Splitting(const BeamArray& beams, const LineExtractorConfig& config);

  /// Appends the parts of a refined piece, refined: the piece itself where one line is enough.
  /// Answers whether it was divided.
  bool split(const Piece& piece, std::vector<Piece>& parts);
  /// Puts the break between two pieces that meet at an obtuse angle where two lines, fitted anew
  /// for every break, explain the returns of both best: the lines that they have owe their
  /// directions to a wrong break. False where there is nothing to do.
  bool settle(Piece& before, Piece& after);

 private:
  static constexpr std::size_t kMostBlocks = 32;
  struct Break {
    std::size_t at;  // block
    double cost;
  };

  void layOut(std::size_t first, std::size_t end);
  double price() const;
  bool isBent(const Piece& piece);
  void score(const Piece& piece);
  LineScores scoresOf(std::size_t block) const;
  bool gather(std::size_t first, std::size_t end, const LineEstimate& about,
              const LineEstimate& before, const LineEstimate& after);
  std::size_t beginOf(std::size_t block) const;
  double reachOfNoise(const Piece& before, const Piece& after) const;
  bool adjoin(const Piece& before, const Piece& after) const;
  LineEstimate middleLine(const Piece& before, const Piece& after) const;
  LineSums sumOf(std::size_t first, std::size_t end, const LineEstimate& before,
                 const LineEstimate& after) const;
  double costOf(std::size_t first, std::size_t end) const;
  Break bestOfTwo() const;
  void divide(double price);
  Piece part(std::size_t first, std::size_t end) const;
  bool append(std::vector<Piece>& parts) const;

  const BeamArray& beams_;
  Gap gap_;
  std::size_t fewest_;  // returns of a part
  double gate_squared_;
  double price_;
  std::size_t first_ = 0;  // returns that have been gathered
  std::size_t end_ = 0;
  LineEstimate about_;      // line that the sums are about
  double reference_ = 0.0;  // position on it [m]
  std::size_t block_ = 0;   // returns of a block
  std::size_t blocks_ = 0;
  std::size_t fewest_blocks_ = 0;                            // of a part
  std::array<LineScores, kMostBlocks + kLanes + 1> scores_;  // prefix sums, lane by lane
  std::array<LineSums, kMostBlocks + 1> before_;             // prefix sums
  std::array<double, kMostBlocks + 1> least_{};              // cost of the blocks before
  std::array<std::size_t, kMostBlocks + 1> from_;            // where the last of their lines begins
};

}  // namespace sightline::lines
