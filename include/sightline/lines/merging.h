#pragma once

#include <Eigen/Core>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/piece.h"
#include "sightline/lines/sweep_noise.h"
#include "sightline/lines/wall_shape.h"

namespace sightline::lines {

/// Squared Mahalanobis distance of two lines in (ρ, φ), which has two degrees of freedom if they
/// are one. The frame's origin is put on `before` at `position` for it: near the place where the
/// pieces meet, the lines are nearly linear in their parameters. `other_noise` is the covariance
/// of their difference, seen from there, that other things than the beams make.
double mahalanobisSquared(const LineEstimate& before, const LineEstimate& after, double position,
                          const Eigen::Matrix2d& other_noise = Eigen::Matrix2d::Zero());

/// Joins neighbouring pieces of one wall.
class Merging {
 public:
  Merging(const BeamArray& beams, SweepNoise& sweep_noise, const LineExtractorConfig& config);

  /// Makes one piece of two where they lie on one line, nothing wider than the gap limit is between
  /// them, and the line through both explains their returns.
  bool merge(Piece& before, const Piece& after) const;

 private:
  bool mayBeOne(const Piece& before, const Piece& after, double position, double gap) const;
  bool goesOn(const LineEstimate& line, std::size_t last, std::size_t next) const;
  double lengthOf(const Piece& piece) const;

  const BeamArray& beams_;
  SweepNoise& sweep_noise_;
  Gap gap_;
  WallShape shape_;
  double gate_;
  double chi_square_ratio_;
  double distance_limit_;
};

}  // namespace sightline::lines
