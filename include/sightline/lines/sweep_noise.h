#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "sightline/geometry/line_segment.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/piece.h"
#include "sightline/motion/motion_sum.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// Effect of drift and walk of the sensor's motion on the lines extracted from a scan (pears eqs
/// 14, 21, 23 and 24). Errors of one beam each, jitter among them, are in the BeamArray.
///
/// A line is fitted with the weights that the noise of the beams asks for; how it answers to a
/// displacement of each beam is linear, and so the covariance of the motion goes into that of the
/// line exactly, to first order: beams that move together are not taken for independent.
class SweepNoise {
 public:
  /// Refers to both until the next call.
  void assign(const scan::Scan& scan, const BeamArray& beams);
  /// Whether there is neither drift nor walk; nothing else is to be asked then.
  bool isZero() const { return is_zero_; }

  /// Covariance of (ρ, φ), on top of what the noise of the beams makes of a refined piece.
  Eigen::Matrix2d ofLine(const Piece& piece, double gate_squared);
  /// Covariance of the difference of two lines in (ρ, φ), seen from a position on the first.
  Eigen::Matrix2d ofDifference(const Piece& before, const Piece& after, double position,
                               double gate_squared);

  /// Takes the noise into the covariance of a piece's segment and the variances of its ends.
  void widen(const Piece& piece, double gate_squared, geometry::LineSegment& segment);

 private:
  Eigen::Matrix2d ofPoint(const Eigen::Vector2d& point, std::size_t beam) const;
  Eigen::RowVector3d acrossLine(const LineEstimate& line, std::size_t beam) const;
  void addTo(const Piece& piece, const Eigen::Matrix2d& jacobian, double gate_squared);

  const scan::Scan* scan_ = nullptr;
  const BeamArray* beams_ = nullptr;
  bool is_zero_ = true;
  motion::MotionSum<2> sum_;
};

}  // namespace sightline::lines
