#pragma once

#include <limits>
#include <string>

namespace sightline::config {

/// Bounds that a number has to keep, both included.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();

  bool contains(double value) const { return value >= min && value <= max; }
  /// Text for messages and tables: `[0, 1]`, `> 0`, `>= 0`, `any`.
  std::string text() const;
};
constexpr Range kPositive{std::numeric_limits<double>::min(), std::numeric_limits<double>::max()};
constexpr Range kNotNegative{0.0, std::numeric_limits<double>::max()};

}  // namespace sightline::config
