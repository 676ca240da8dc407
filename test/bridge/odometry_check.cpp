#include "sightline/bridge/odometry_check.h"

#include <gtest/gtest.h>

namespace sightline::bridge {
namespace {

// Drives ahead by 1 m/s at 10 Hz.
OdometryCheck drive(int poses) {
  OdometryCheck check;
  for (int i = 0; i < poses; ++i) check.add(i * 100'000'000L, {0.1 * i, 0.0, 0.0});
  return check;
}

TEST(OdometryCheck, AddsUpWhatWasDriven) {
  const OdometrySummary summary = drive(51).summary();
  EXPECT_EQ(summary.poses, 51U);
  EXPECT_NEAR(summary.distance, 5.0, 1e-9);
  EXPECT_EQ(summary.jumps, 0U);
}

TEST(OdometryCheck, CountsAJumpOnceAndLeavesItOut) {
  OdometryCheck check = drive(51);
  check.add(5'100'000'000L, {0.0, 0.0, 0.0});
  check.add(5'200'000'000L, {0.1, 0.0, 0.0});
  EXPECT_EQ(check.summary().jumps, 1U);
  EXPECT_EQ(check.summary().first_jump, 5'100'000'000L);
  EXPECT_NEAR(check.summary().distance, 5.1, 1e-9);
}

TEST(OdometryCheck, LeavesOutStampsThatDoNotRise) {
  OdometryCheck check = drive(10);
  check.add(900'000'000L, {5.0, 0.0, 0.0});
  check.add(100'000'000L, {5.0, 0.0, 0.0});
  EXPECT_EQ(check.summary().jumps, 0U);
  EXPECT_EQ(check.poses().size(), 10U);
}

}  // namespace
}  // namespace sightline::bridge
