#pragma once

#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/piece.h"

namespace sightline::lines {

/// Moves the ends of pieces to where the beams say they are, their lines held.
class BreakPoints {
 public:
  BreakPoints(const BeamArray& beams, const LineExtractorConfig& config);

  /// Adds the returns after (before) a piece that are on its line, up to (down to) `limit`. Past
  /// returns that are not, two in a row are needed, or one where all of those are in front of the
  /// line and hide it.
  void extendForward(Piece& piece, std::size_t limit) const;
  void extendBackward(Piece& piece, std::size_t limit) const;
  /// The same, but nothing before `from` (from there on) is looked at: something else is there.
  void extendForward(Piece& piece, std::size_t from, std::size_t limit) const;
  void extendBackward(Piece& piece, std::size_t from, std::size_t limit) const;
  /// Takes returns off the ends that are not within the gate.
  void trim(Piece& piece) const;
  /// Puts the break between two pieces where their lines together explain the returns best.
  void separate(Piece& before, Piece& after) const;

 private:
  struct Break {
    std::size_t at = 0;
    double cost = 0.0;
  };
  Break bestBreak(const LineEstimate& before, const LineEstimate& after, std::size_t low,
                  std::size_t high) const;
  bool adjoin(const Piece& before, const Piece& after, const LineEstimate& line) const;
  bool isOn(const LineEstimate& line, std::size_t i) const;

  const BeamArray& beams_;
  Gap gap_;
  float gate_squared_;
};

}  // namespace sightline::lines
