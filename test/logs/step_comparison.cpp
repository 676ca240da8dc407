#include "sightline/logs/step_comparison.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace sightline::logs {
namespace {

using geometry::Pose2;

constexpr std::int64_t kOneSecond = 1'000'000'000;

// Swerves along x: the heading is a sum of sines, the speed .5 m/s.
Pose2 truthAt(double time, double turning) {
  const double heading = turning * (0.6 * std::sin(1.1 * time) + 0.3 * std::sin(2.9 * time));
  return {0.5 * time, 0.0, heading};
}

Trajectory odometry(double scale, double turning) {
  Trajectory trajectory;
  for (int i = 0; i < 2500; ++i) {
    Pose2 pose = truthAt(0.02 * i, turning);
    trajectory.push_back({i * kOneSecond / 50, {pose.x() / scale, pose.y() / scale, pose.theta()}});
  }
  return trajectory;
}

// Steps between scans at 10 Hz whose stamps are `late`.
std::vector<ScanStep> steps(double late, double turning) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.002);
  std::vector<ScanStep> result;
  for (int i = 20; i < 400; ++i) {
    const double before = 0.1 * i;
    const double now = before + 0.1;
    const Pose2 step = truthAt(before, turning).inverse() * truthAt(now, turning);
    const auto stamp = [&](double time) { return std::llround(1e9 * (time + late)); };
    result.push_back(
        {stamp(before), stamp(now), {step.x(), step.y(), step.theta() + noise(random)}});
  }
  return result;
}

TEST(StepComparison, FindsHowLateTheScansAre) {
  for (const double late : {-0.2, -0.033, 0.0, 0.097, 0.3}) {
    SCOPED_TRACE(late);
    const StepComparison result = compareSteps(steps(late, 1.0), odometry(1.0, 1.0));
    ASSERT_TRUE(result.offset);
    EXPECT_NEAR(*result.offset, late, 4.0 * result.offset_sigma + 0.001);
    EXPECT_LT(result.offset_sigma, 0.005);
  }
}

TEST(StepComparison, IsNotMisledByAFewWrongSteps) {
  auto wrong = steps(0.05, 1.0);
  for (std::size_t i = 0; i < wrong.size(); i += 10) wrong[i].motion = {0.0, 0.0, 1.0};
  const StepComparison result = compareSteps(wrong, odometry(1.0, 1.0));
  ASSERT_TRUE(result.offset);
  EXPECT_NEAR(*result.offset, 0.05, 0.01);
}

TEST(StepComparison, SaysNothingOfTheTimeWhereNothingTurns) {
  EXPECT_FALSE(compareSteps(steps(0.1, 0.0), odometry(1.0, 0.0)).offset);
}

TEST(StepComparison, FindsTheScaleOfTheOdometry) {
  const StepComparison result = compareSteps(steps(0.0, 0.0), odometry(1.05, 0.0));
  ASSERT_TRUE(result.scale);
  EXPECT_NEAR(*result.scale, 1.05, 0.005);
}

TEST(StepComparison, OfNothingIsNothing) {
  EXPECT_FALSE(compareSteps({}, {}).offset);
  EXPECT_FALSE(compareSteps(steps(0.0, 1.0), {}).scale);
}

}  // namespace
}  // namespace sightline::logs
