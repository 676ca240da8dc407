#include "sightline/geometry/angle.h"

#include <limits>

#include <gtest/gtest.h>

namespace sightline::geometry {
namespace {

TEST(WrapAngle, KeepsWhatIsInRange) {
  for (const double angle : {-3.14, -1.0, 0.0, 1e-300, 2.0, kPi}) {
    EXPECT_EQ(wrapAngle(angle), angle);
  }
}

TEST(WrapAngle, MinusPiBecomesPi) {
  EXPECT_EQ(wrapAngle(-kPi), kPi);
  EXPECT_EQ(wrapAngle(3.0 * kPi), kPi);
}

TEST(WrapAngle, TakesWholeTurnsAway) {
  for (int turns = -1000; turns <= 1000; turns += 7) {
    EXPECT_NEAR(wrapAngle(1.25 + turns * 2.0 * kPi), 1.25, 1e-11);
    EXPECT_NEAR(wrapAngle(-3.1 + turns * 2.0 * kPi), -3.1, 1e-11);
  }
}

TEST(WrapAngle, NoNumberStaysNoNumber) {
  EXPECT_TRUE(std::isnan(wrapAngle(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(wrapAngle(std::numeric_limits<double>::infinity())));
}

TEST(WrapOrientation, TakesHalfTurnsAway) {
  EXPECT_EQ(wrapOrientation(-0.5 * kPi), 0.5 * kPi);
  EXPECT_EQ(wrapOrientation(0.5 * kPi), 0.5 * kPi);
  for (int halves = -20; halves <= 20; ++halves) {
    EXPECT_NEAR(wrapOrientation(0.3 + halves * kPi), 0.3, 1e-13);
    EXPECT_NEAR(wrapOrientation(-1.5 + halves * kPi), -1.5, 1e-13);
  }
}

TEST(Degrees, AreTheInverseOfRadians) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(degrees(radians(37.5)), 37.5);
}

}  // namespace
}  // namespace sightline::geometry
