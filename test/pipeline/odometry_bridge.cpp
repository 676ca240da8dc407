#include "sightline/pipeline/odometry_bridge.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sightline/motion/pose_history.h"

namespace sightline::pipeline {
namespace {

using geometry::Pose2;

constexpr std::int64_t kTick = 1'000'000;

// A carrier on an arc, whose odometry comes every so many milliseconds; from a time on it is moved.
class OdometryBridgeTest : public testing::Test {
 protected:
  static Pose2 truth(double time) { return Pose2::exp({0.5 * time, 0.0, 0.4 * time}); }

  void drive(int period, double when, const Pose2& leap) {
    for (int tick = 0; tick <= 4000; tick += period) {
      const double time = 1e-3 * tick;
      const Pose2 pose = time >= when ? leap * truth(time) : truth(time);
      history_.add(tick * kTick, pose);
    }
  }
  // Follows at 10 Hz; returns how often it broke, and compares the last pose with the truth.
  int breaks(double position = 1e-3) {
    const auto poseAt = [this](std::int64_t stamp) { return history_.at(stamp); };
    int count = 0;
    OdometryBridge::Step step;
    for (int tick = 50; tick <= 3950; tick += 100) {
      step = bridge_.follow(tick * kTick, poseAt);
      if (step.is_broken) ++count;
    }
    const Pose2 start = truth(0.05);
    const Pose2 error = geometry::between(geometry::between(start, truth(3.95)),
                                          geometry::between(start, step.T_path_base));
    EXPECT_LT(error.translation().norm(), position);
    EXPECT_LT(std::abs(error.theta()), position);
    return count;
  }

  motion::PoseHistory history_;
  OdometryBridge bridge_{OdometryLimits()};
};

TEST_F(OdometryBridgeTest, FollowsOdometryThatGoesOn) {
  drive(20, 10.0, Pose2());
  EXPECT_EQ(breaks(), 0);
}

TEST_F(OdometryBridgeTest, BridgesAReset) {
  drive(20, 2.0, truth(2.0).inverse());
  EXPECT_EQ(breaks(0.02), 1);
}

TEST_F(OdometryBridgeTest, BridgesLeapsOfSlowOdometryThatIsReadBetweenSamples) {
  for (const Pose2& leap : {Pose2(0.3, 0.0, 0.0), Pose2(0.0, -5.0, 0.0), Pose2(0.0, 0.0, 2.5)}) {
    history_.clear();
    bridge_ = OdometryBridge(OdometryLimits());
    drive(100, 2.0, leap);
    EXPECT_GE(breaks(0.15), 1) << leap.x();
  }
}

TEST_F(OdometryBridgeTest, OneSampleFarOffIsBridgedToo) {
  drive(20, 10.0, Pose2());
  history_ = motion::PoseHistory();
  for (int tick = 0; tick <= 4000; tick += 20) {
    const Pose2 pose = truth(1e-3 * tick);
    history_.add(tick * kTick, tick == 2000 ? Pose2(1e4, 0.0, 0.0) * pose : pose);
  }
  EXPECT_GE(breaks(0.03), 1);
}

// Rounded to 1 cm and 0.01 rad, and stamped up to 10 ms late.
TEST_F(OdometryBridgeTest, RoughOdometryIsNoBreak) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> late(0, 10);
  for (int tick = 0; tick <= 4000; tick += 20) {
    const Pose2 pose = truth(1e-3 * tick);
    const auto rounded = [](double value) { return 0.01 * std::round(100.0 * value); };
    history_.add((tick + late(random)) * kTick,
                 Pose2(rounded(pose.x()), rounded(pose.y()), rounded(pose.theta())));
  }
  EXPECT_EQ(breaks(0.03), 0);
}

// Stamps of arrival: four scans in 3 ms, then a pause.
TEST_F(OdometryBridgeTest, StampsInBurstsAreNoLeaps) {
  const scan::ElapsedTime period{0.2, 0.8, 0.004};
  int broken = 0;
  for (int i = 0; i < 40; ++i) {
    const std::int64_t stamp = (i / 4 * 800 + i % 4) * kTick;
    const auto poseAt = [&](std::int64_t) { return truth(0.2 * i); };
    broken += bridge_.follow(stamp, poseAt, period).is_broken;
  }
  EXPECT_EQ(broken, 0);
}

TEST_F(OdometryBridgeTest, GoesOnWhereTheClockWasSet) {
  const auto poseAt = [](std::int64_t stamp) { return truth(1e-9 * static_cast<double>(stamp)); };
  bridge_.follow(1000 * kTick, poseAt);
  bridge_.restartClock();
  EXPECT_FALSE(bridge_.follow(900 * kTick, poseAt).is_broken);
  bridge_.restartClock();
  const auto step = bridge_.follow(900 * kTick, [](std::int64_t) { return Pose2(50, 0, 0); });
  EXPECT_TRUE(step.is_broken);
  EXPECT_LT(step.T_path_base.translation().norm(), 2.0);
}

TEST_F(OdometryBridgeTest, KnowsWhetherASweepIsWhole) {
  drive(20, 2.0, Pose2(1.0, 0.0, 0.0));
  const auto poseAt = [this](std::int64_t stamp) { return history_.at(stamp); };
  EXPECT_TRUE(bridge_.isContinuous(1000 * kTick, 1100 * kTick, poseAt));
  EXPECT_FALSE(bridge_.isContinuous(1950 * kTick, 2050 * kTick, poseAt));
  EXPECT_FALSE(bridge_.isContinuous(3950 * kTick, 4050 * kTick, poseAt));
}

}  // namespace
}  // namespace sightline::pipeline
