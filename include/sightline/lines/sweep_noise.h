#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/arc.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/piece.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// Covariance of Σ Gᵢ e(sᵢ), where e(s) is the error of the sensor's coordinates (x, y, θ) at the
/// ratio s of the sweep's time: cov(e(s), e(s')) = s s' drift + min(s, s') walk.
class MotionSum {
 public:
  using Response = Eigen::Matrix<double, 2, 3>;

  void clear() { terms_.clear(); }
  void add(double time_ratio, const Response& response) {
    terms_.push_back({time_ratio, response});
  }
  /// In one pass over the terms, from the latest to the earliest: the stretch of walk between two
  /// of them moves all that come after it.
  Eigen::Matrix2d covariance(const scan::MotionNoise& noise);

 private:
  struct Term {
    double time_ratio;
    Response response;
  };
  std::vector<Term> terms_;
};

/// What drift and walk of the sensor's motion do to what is extracted from a scan (pears eqs 14,
/// 21, 23 and 24). Errors of one beam each, jitter among them, are in the BeamArray.
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
  /// Covariance of a point that the sensor saw at a beam of the scan [m²].
  Eigen::Matrix2d ofPoint(const Eigen::Vector2d& point, std::size_t beam) const;
  /// Variance across a line of the motion from one return to another, which eq. 21 adds to the
  /// prediction (Q) [m²].
  double ofPrediction(const LineEstimate& line, std::size_t from, std::size_t to) const;

  /// Take the noise into the covariance of a piece's segment and the variances of its ends.
  void widen(const Piece& piece, double gate_squared, geometry::LineSegment& segment);
  /// The arc moves as its middle does.
  void widen(geometry::Arc& arc) const;

 private:
  double timeRatio(std::size_t beam) const;
  Eigen::Matrix3d ofMotion(double time_ratio) const;
  Eigen::Vector2d origin(std::size_t beam) const;
  void addTo(const Piece& piece, const Eigen::Matrix2d& jacobian, double gate_squared);

  const scan::Scan* scan_ = nullptr;
  const BeamArray* beams_ = nullptr;
  bool is_zero_ = true;
  MotionSum sum_;
};

}  // namespace sightline::lines
