#pragma once

#include <cmath>

namespace sightline::geometry {

constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double degrees) {
  return degrees * (kPi / 180.0);
}
constexpr double degrees(double radians) {
  return radians * (180.0 / kPi);
}

/// The same direction in (−π, π]. NaN and infinities give NaN.
inline double wrapAngle(double angle) {
  if (std::abs(angle) < kPi) return angle;
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// The same undirected orientation in (−π/2, π/2]: walls look alike from both ends.
inline double wrapOrientation(double angle) {
  if (std::abs(angle) < 0.5 * kPi) return angle;
  const double wrapped = std::remainder(angle, kPi);
  return wrapped <= -0.5 * kPi ? 0.5 * kPi : wrapped;
}

}  // namespace sightline::geometry
