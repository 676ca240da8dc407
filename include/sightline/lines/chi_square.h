#pragma once

#include <cmath>

namespace sightline::lines {

/// The value that χ² with `degrees_of_freedom` exceeds about as rarely as a standard normal exceeds
/// `sigmas` (Wilson and Hilferty 1931).
inline double chiSquareLimit(double sigmas, double degrees_of_freedom) {
  const double spread = 2.0 / (9.0 * degrees_of_freedom);
  const double root = 1.0 - spread + sigmas * std::sqrt(spread);
  return degrees_of_freedom * root * root * root;
}

}  // namespace sightline::lines
