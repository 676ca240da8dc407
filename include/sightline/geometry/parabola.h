#pragma once

#include <optional>

namespace sightline::geometry {

/// Lowest point of a parabola.
struct LowestPoint {
  double offset = 0.0;  ///< from the middle value, in steps
  double bend = 0.0;    ///< second difference of the values, above 0
};

/// Lowest point of the parabola through three values that are one step apart. Nothing where they do
/// not bend upwards, or are not finite.
std::optional<LowestPoint> lowestPoint(double before, double middle, double after);

}  // namespace sightline::geometry
