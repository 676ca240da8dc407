#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_estimate.h"

namespace sightline::lines {

/// Weighted moments of returns, from which the line through any run of them follows by sums alone.
///
/// A line not through the origin is u · p = 1 with u = n/ρ, which is linear in u. A return p at the
/// range r with the variance R misses it by ν = (n·p − ρ)/(n·d), so that ν²/R is (1 − u · p)² v
/// with the weight v = r²/R to first order: unlike the weights of (ρ, φ) it does not ask for the
/// line.
struct LineMoments {
  /// Share of the product of two squares that a determinant keeps where it is more than rounding.
  static constexpr double kLeastDeterminant = 1e-12;

  double one = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0,
         yy = 0.0;  ///< Σ v p pᵀ, with 1 for p; p [m] in the sensor's frame, v without unit

  LineMoments& operator+=(const LineMoments& other) {
    one += other.one;
    x += other.x;
    y += other.y;
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
    return *this;
  }
  LineMoments& operator-=(const LineMoments& other) {
    one -= other.one;
    x -= other.x;
    y -= other.y;
    xx -= other.xx;
    xy -= other.xy;
    yy -= other.yy;
    return *this;
  }
  /// χ² about the line that fits best; that of no line where none is determined.
  double cost() const {
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > kLeastDeterminant * xx * yy)) return one;
    return std::max(0.0, one - (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant);
  }
  /// Whether cost() is no more than a limit, without a division.
  bool costsAtMost(double limit) const {
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > kLeastDeterminant * xx * yy)) return one <= limit;
    return (one - limit) * determinant <= yy * x * x - 2.0 * xy * x * y + xx * y * y;
  }
  /// χ² about a line, which must not go through the origin.
  double costAbout(const LineEstimate& line) const {
    const double ux = line.normal_x / line.rho;
    const double uy = line.normal_y / line.rho;
    return one - 2.0 * (ux * x + uy * y) + ux * ux * xx + 2.0 * ux * uy * xy + uy * uy * yy;
  }
  /// Σ v p.
  Eigen::Vector2d first() const { return {x, y}; }
  /// Of u: the inverse of Σ v p pᵀ, which has to be determined.
  Eigen::Matrix2d covariance() const {
    const double scale = 1.0 / (xx * yy - xy * xy);
    Eigen::Matrix2d result;
    result << scale * yy, -scale * xy, -scale * xy, scale * xx;
    return result;
  }
  /// Normal and distance of that line, without information; the normal points away from the origin.
  LineEstimate line() const;
};

/// Squared distance, in standard deviations, between two lines where they are met in directions
/// between two (of any length), 0 where they cross between these: how much their χ² grows where
/// they are made to meet there.
double apartSquared(const LineMoments& a, const LineMoments& b, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to);

/// Moments of the returns [first, end).
LineMoments momentsOf(const BeamArray& beams, std::size_t first, std::size_t end);
/// Moments of one return.
LineMoments momentsOf(const BeamArray& beams, std::size_t of_return);

}  // namespace sightline::lines
