#include "sightline/geometry/attitude.h"

#include <gtest/gtest.h>

#include "sightline/geometry/angle.h"

namespace sightline::geometry {
namespace {

TEST(Attitude, PositivePitchLooksDownAndPositiveRollLeansRight) {
  const double angle = radians(10.0);
  const Eigen::Vector3d ahead = Attitude{0.0, angle}.rotation() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.z(), -std::sin(angle), 1e-12);
  EXPECT_NEAR(ahead.x(), std::cos(angle), 1e-12);
  const Eigen::Vector3d left = Attitude{angle, 0.0}.rotation() * Eigen::Vector3d::UnitY();
  EXPECT_NEAR(left.z(), std::sin(angle), 1e-12);
}

TEST(Attitude, BodyAxisXKeepsTheHeadingWhateverTheRoll) {
  const Eigen::Vector3d ahead = Attitude{0.3, 0.2}.rotation() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.y(), 0.0, 1e-12);
  EXPECT_NEAR(ahead.z(), -std::sin(0.2), 1e-12);
}

}  // namespace
}  // namespace sightline::geometry
