#include "sightline/logs/carmen_odometry.h"

#include <gtest/gtest.h>

namespace sightline::logs {
namespace {

using geometry::Pose2;

constexpr std::int64_t kSecond = 1'000'000'000;

CarmenLaser scanAt(std::int64_t stamp, const Pose2& robot) {
  CarmenLaser laser;
  laser.stamp = stamp;
  laser.robot = robot;
  return laser;
}

TEST(CarmenOdometry, PrefersTheLinesOfTheRobot) {
  CarmenLog log;
  log.scans = {scanAt(kSecond, {5, 5, 0}), scanAt(2 * kSecond, {6, 5, 0})};
  log.odometry = {{kSecond, {1, 0, 0}, {0.4, 0.0}}, {2 * kSecond, {2, 0, 0}, {0.6, 0.0}}};
  const auto odometry = odometryOf(log);
  ASSERT_EQ(odometry.size(), 2U);
  EXPECT_EQ(odometry[1].robot.x(), 2.0);
  EXPECT_EQ(odometry[1].velocity.translation, 0.6);
  EXPECT_TRUE(hasVelocity(log));
}

TEST(CarmenOdometry, FallsBackOnThePosesOfTheScans) {
  CarmenLog log;
  const Pose2 start(1.0, 2.0, 0.3);
  log.scans = {scanAt(kSecond, start), scanAt(3 * kSecond, start * Pose2::exp({0.8, 0.0, 0.2}))};
  const auto odometry = odometryOf(log);
  ASSERT_EQ(odometry.size(), 2U);
  EXPECT_EQ(odometry[0].robot.coordinates(), start.coordinates());
  EXPECT_NEAR(odometry[1].velocity.translation, 0.4, 1e-12);
  EXPECT_NEAR(odometry[1].velocity.rotation, 0.1, 1e-12);
  EXPECT_FALSE(hasVelocity(log));
}

TEST(CarmenOdometry, KeepsTheLaterOfTwoPosesWithOneStamp) {
  CarmenLog log;
  log.odometry = {{kSecond, {1, 0, 0}, {}}, {kSecond, {2, 0, 0}, {}}, {2 * kSecond, {3, 0, 0}, {}}};
  const auto odometry = odometryOf(log);
  ASSERT_EQ(odometry.size(), 2U);
  EXPECT_EQ(odometry[0].robot.x(), 2.0);
}

TEST(ReverseFromVelocity, TurnsRoundOnlyWhatContradictsTheVelocity) {
  const Pose2 start(1.0, 2.0, 0.7);
  const Pose2 forward(0.5, 0.02, 0.1);
  const Pose2 backward(-0.5, -0.02, 0.1);
  // Forward, forward though it backed, backward as it backed.
  std::vector<CarmenOdometry> odometry = {
      {1, start, {0.5, 0.0}},
      {2, start * forward, {0.5, 0.0}},
      {3, start * forward * forward, {-0.5, 0.0}},
      {4, start * forward * forward * backward, {-0.5, 0.0}},
  };
  reverseFromVelocity(odometry);
  const Pose2 expected = start * forward * backward * backward;
  EXPECT_NEAR((odometry[3].robot.coordinates() - expected.coordinates()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((odometry[1].robot.coordinates() - (start * forward).coordinates()).norm(), 0, 1e-12);
}

TEST(ReverseFromVelocity, TakesNoOdometry) {
  std::vector<CarmenOdometry> none;
  reverseFromVelocity(none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace sightline::logs
