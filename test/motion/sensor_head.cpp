#include "sightline/motion/sensor_head.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sightline/geometry/angle.h"

namespace sightline::motion {
namespace {

using Mode = HeadCommand::Mode;

TEST(SensorHead, TurnsAQuarterInHalfASecond) {
  SensorHead head({});
  head.command({Mode::kPosition, geometry::radians(90.0), 0.0});
  for (int i = 0; i < 1240; ++i) head.step(0.0004);
  EXPECT_LT(head.angle(), geometry::radians(90.0));
  for (int i = 0; i < 30; ++i) head.step(0.0004);
  EXPECT_NEAR(head.angle(), geometry::radians(90.0), 1e-12);
  EXPECT_EQ(head.rate(), 0.0);
}

TEST(SensorHead, StaysWithinItsLimitsAndSteps) {
  const HeadLimits limits;
  SensorHead head(limits);
  head.command({Mode::kRate, 0.0, -3.0});
  double least = 0.0;
  for (int i = 0; i < 2500; ++i) {
    head.step(0.0004);
    least = std::min(least, head.angle());
  }
  EXPECT_NEAR(least, limits.lower, 1e-6);
  EXPECT_NEAR(head.rate(), 0.0, 0.02);
  head.command({Mode::kPosition, 0.5001, 0.0});
  for (int i = 0; i < 2500; ++i) head.step(0.0004);
  EXPECT_NEAR(head.angle(), 80 * limits.resolution, 1e-12);  // 0.5027 rad, the nearest step
}

TEST(SensorHead, KeepsARateAndStops) {
  SensorHead head({});
  head.command({Mode::kRate, 0.0, 0.8});
  for (int i = 0; i < 1250; ++i) head.step(0.0004);
  EXPECT_NEAR(head.rate(), 0.8, 1e-12);
  EXPECT_NEAR(head.angle(), 0.4, 0.02);
  head.command({Mode::kStop, 0.0, 0.0});
  for (int i = 0; i < 250; ++i) head.step(0.0004);
  EXPECT_EQ(head.rate(), 0.0);
  EXPECT_NEAR(head.angle(), head.limits().rounded(head.angle()), 1e-12);  // on a step
}

TEST(SensorHead, CountsOnlyStepsWithinItsLimits) {
  HeadLimits limits;
  limits.upper = 1.5;  // between two steps
  EXPECT_LT(limits.rounded(1.5), 1.5);
  EXPECT_GT(limits.rounded(1.5), 1.5 - limits.resolution);
  SensorHead head(limits);
  head.command({Mode::kPosition, 1.5, 0.0});
  for (int i = 0; i < 2500; ++i) head.step(0.0004);
  EXPECT_NEAR(head.angle(), limits.rounded(1.5), 1e-12);
}

TEST(SensorHead, DoesNothingThatItsLimitsForbid) {
  SensorHead head({});
  head.command({Mode::kPosition, 2.0, 0.0});
  head.command({Mode::kPosition, std::nan(""), 0.0});
  head.command({Mode::kRate, 0.0, 50.0});
  for (int i = 0; i < 250; ++i) head.step(0.0004);
  EXPECT_EQ(head.angle(), 0.0);
}

}  // namespace
}  // namespace sightline::motion
