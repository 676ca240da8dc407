#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "sightline/geometry/parabola.h"

namespace sightline::pipeline {

/// Value of a parameter that data have determined.
struct Determined {
  double value = 0.0;
  double sigma = 0.0;  ///< standard deviation
};

/// Evenly spaced values of one parameter that are tried.
struct EvenValues {
  double widest = 0.0;  ///< values from minus this to this
  double step = 1.0;    ///< between two values

  std::size_t size() const { return 2 * static_cast<std::size_t>(std::lround(widest / step)) + 1; }
  double at(double place) const { return -widest + step * place; }
  double at(std::size_t i) const { return at(static_cast<double>(i)); }

  /// Value of the least cost, at the lowest point of the parabola through it and its neighbours.
  /// Nothing where it is at an end, and the least may lie outside.
  ///
  /// @param costs     of each value, sums of squares
  /// @param least     where they are least
  /// @param residual  variance of one of the residuals: a cost that is higher by it is one sigma
  /// off
  template <typename Costs>
  std::optional<Determined> least(const Costs& costs, std::size_t least, double residual) const {
    if (least == 0 || least + 1 >= size()) return std::nullopt;
    const auto lowest = geometry::lowestPoint(costs(least - 1), costs(least), costs(least + 1));
    if (!lowest) return std::nullopt;
    return Determined{at(static_cast<double>(least) + lowest->offset),
                      step * std::sqrt(2.0 * residual / lowest->bend)};
  }
};

}  // namespace sightline::pipeline
