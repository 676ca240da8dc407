#pragma once

#include "sightline/lines/beam_array.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/piece.h"

namespace sightline::lines {

/// Squared Mahalanobis distance of two lines in (ρ, φ), which has two degrees of freedom if they
/// are one. The frame's origin is put on `before` at `position` for it: near the place where the
/// pieces meet, the lines are nearly linear in their parameters.
double mahalanobisSquared(const LineEstimate& before, const LineEstimate& after, double position);

/// Joins neighbouring pieces of one wall.
class Merging {
 public:
  Merging(const BeamArray& beams, const LineExtractorConfig& config);

  /// Makes one piece of two where they lie on one line, nothing wider than the gap limit is between
  /// them, and the line through both explains their returns.
  bool merge(Piece& before, const Piece& after) const;

 private:
  const BeamArray& beams_;
  Gap gap_;
  double gate_;
  double misfit_;
  double distance_limit_;
};

}  // namespace sightline::lines
