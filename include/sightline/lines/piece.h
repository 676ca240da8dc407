#pragma once

#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_estimate.h"
#include "sightline/lines/line_extractor_config.h"

namespace sightline::lines {

/// A run of returns [first, end) and the line that explains them, stray ones apart.
struct Piece {
  std::size_t first = 0;
  std::size_t end = 0;
  LineEstimate line;
  double beams = 0.0;       ///< returns within the gate
  double chi_square = 0.0;  ///< of those
  /// The returns that line, beams and chi-square are of: refine() makes them those of the piece.
  std::size_t refined_first = 0;
  std::size_t refined_end = 0;

  std::size_t size() const { return end - first; }
};

/// Maximum-likelihood line of the returns of a piece that lie within the gate (pears eq. 37). Where
/// a refined piece has gained or lost a few returns at its ends, only these are looked at. False
/// where they determine no line.
bool refine(const BeamArray& beams, double gate_squared, Piece& piece);

/// Whether it has enough returns, and the noise explains their residuals.
bool isWall(const Piece& piece, const LineExtractorConfig& config);

/// What the covariance of a refined piece is to be multiplied by: 1 where it is straight. Where the
/// noise does not explain its residuals, or those that neighbours share, by χ² over its degrees of
/// freedom; chance alone makes little of it.
double unevenness(const BeamArray& beams, double gate_squared, const Piece& piece);

/// Length of a piece from its first return to its last along the line [m].
double extent(const BeamArray& beams, const Piece& piece);

}  // namespace sightline::lines
