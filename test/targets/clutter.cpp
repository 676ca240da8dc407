// Bearings of nothing, as the simulated sensors draw them.
#include <cmath>

#include <gtest/gtest.h>

#include "sightline/geometry/angle.h"
#include "sightline/targets/simulated_team.h"

namespace sightline::targets {
namespace {

TEST(ClutterStatistics, ClutterHasItsMeanAndShareInThePeaks) {
  const SensorModel model;
  BearingSampler sampler(model, 5);
  double count = 0.0;
  double in_peaks = 0.0;
  constexpr int kScans = 300000;
  for (int i = 0; i < kScans; ++i) {
    const int drawn = sampler.clutterCount();
    count += drawn;
    for (int j = 0; j < drawn; ++j) {
      const double off = std::abs(std::abs(sampler.clutterBearing()) - 0.5 * geometry::kPi);
      if (off <= 0.1 * geometry::kPi) in_peaks += 1.0;
    }
  }
  EXPECT_NEAR(count / kScans / 0.5319, 1.0, 0.01);
  EXPECT_NEAR(in_peaks / count, 0.468, 0.005);
}

}  // namespace
}  // namespace sightline::targets
