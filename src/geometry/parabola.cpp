#include "sightline/geometry/parabola.h"

#include <cmath>

namespace sightline::geometry {

std::optional<LowestPoint> lowestPoint(double before, double middle, double after) {
  const double bend = before - 2.0 * middle + after;
  if (!std::isfinite(bend) || bend <= 0.0) return std::nullopt;
  return LowestPoint{0.5 * (before - after) / bend, bend};
}

}  // namespace sightline::geometry
