#pragma once

#include <cmath>
#include <cstddef>

namespace sightline::lines {

/// The value that χ² with `degrees_of_freedom` exceeds about as rarely as a standard normal exceeds
/// `sigmas` (Wilson and Hilferty 1931).
inline double chiSquareLimit(double sigmas, std::size_t degrees_of_freedom) {
  const auto d = static_cast<double>(degrees_of_freedom);
  const double spread = 2.0 / (9.0 * d);
  const double root = 1.0 - spread + sigmas * std::sqrt(spread);
  return d * root * root * root;
}

}  // namespace sightline::lines
