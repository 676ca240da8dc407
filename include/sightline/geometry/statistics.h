#pragma once

#include <cmath>

/// Quantiles of the normal and the chi-square distribution.
namespace sightline::geometry {

/// 95 % of a normal distribution lie within so many standard deviations of its mean.
constexpr double kNormal95 = 1.959963984540054;
/// 95 % of a chi-square distribution lie below, by degrees of freedom.
constexpr double kChiSquare95Of2 = 5.991464547107979;
constexpr double kChiSquare95Of3 = 7.814727903251179;
/// 95 % of a Gaussian in the plane lie within so many standard deviations: √kChiSquare95Of2.
constexpr double kPlane95 = 2.4477468306808161;

/// The value that χ² with two degrees of freedom exceeds as rarely as a standard normal is beyond
/// ±`sigmas`.
inline double chiSquareLimitOf2(double sigmas) {
  return -2.0 * std::log(std::erfc(sigmas / std::sqrt(2.0)));
}

/// The value that χ² with `degrees_of_freedom` exceeds about as rarely as a standard normal exceeds
/// `sigmas` (Wilson and Hilferty 1931).
inline double chiSquareLimit(double sigmas, double degrees_of_freedom) {
  const double variance = 2.0 / (9.0 * degrees_of_freedom);
  const double root = 1.0 - variance + sigmas * std::sqrt(variance);
  return degrees_of_freedom * root * root * root;
}

}  // namespace sightline::geometry
