// The lowest point of a parabola through three values.
#include "sightline/geometry/parabola.h"

#include <limits>

#include <gtest/gtest.h>

namespace sightline::geometry {
namespace {

TEST(Parabola, LowestPointIsWhereTheParabolaWasMade) {
  const auto value = [](double x) { return 3.0 * (x - 0.3) * (x - 0.3) + 7.0; };
  const auto lowest = lowestPoint(value(-1.0), value(0.0), value(1.0));
  ASSERT_TRUE(lowest);
  EXPECT_NEAR(lowest->offset, 0.3, 1e-12);
  EXPECT_NEAR(lowest->bend, 6.0, 1e-12);
}

TEST(Parabola, ValuesThatDoNotBendUpwardsHaveNone) {
  EXPECT_FALSE(lowestPoint(1.0, 2.0, 3.0));
  EXPECT_FALSE(lowestPoint(1.0, 2.0, 1.0));
  EXPECT_FALSE(lowestPoint(std::numeric_limits<double>::infinity(), 1.0, 2.0));
}

}  // namespace
}  // namespace sightline::geometry
