#include "sightline/tracking/sweep_error.h"

#include <algorithm>

namespace sightline::tracking {

SweepErrorCovariance SweepNoise::atKnots() const {
  SweepErrorCovariance covariance;
  for (int i = 0; i < kKnots; ++i) {
    for (int j = 0; j < kKnots; ++j) {
      const double first = static_cast<double>(i + 1) / kKnots;
      const double second = static_cast<double>(j + 1) / kKnots;
      covariance.block<3, 3>(3 * i, 3 * j) =
          first * second * drift + std::min(first, second) * walk;
    }
  }
  return covariance;
}

}  // namespace sightline::tracking
