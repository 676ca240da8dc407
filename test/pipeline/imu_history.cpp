#include "sightline/pipeline/imu_history.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sightline::pipeline {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

// 100 Hz, from 1 s to 2 s, turning ever faster: by t²/2.
ImuHistory speedingUp() {
  ImuHistory history;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.01 * i;
    history.add({(1000 + 10 * i) * kMillisecond, t, geometry::Attitude{0.1 * t, -0.2 * t}});
  }
  return history;
}

TEST(ImuHistory, AddsUpTheTurn) {
  const ImuHistory history = speedingUp();
  EXPECT_NEAR(*history.turn(1000 * kMillisecond, 2000 * kMillisecond), 0.5, 1e-9);
  EXPECT_NEAR(*history.turn(1500 * kMillisecond, 1900 * kMillisecond), 0.5 * (0.81 - 0.25), 1e-9);
  EXPECT_NEAR(*history.turn(1503 * kMillisecond, 1777 * kMillisecond),
              0.5 * (std::pow(0.777, 2) - std::pow(0.503, 2)), 1e-4);
}

TEST(ImuHistory, InterpolatesTheAttitude) {
  const ImuHistory history = speedingUp();
  EXPECT_NEAR(history.attitude(1505 * kMillisecond)->roll, 0.0505, 1e-9);
  EXPECT_NEAR(history.attitude(1505 * kMillisecond)->pitch, -0.101, 1e-9);
}

TEST(ImuHistory, KnowsNothingOutside) {
  const ImuHistory history = speedingUp();
  EXPECT_FALSE(history.turn(999 * kMillisecond, 1500 * kMillisecond));
  EXPECT_FALSE(history.turn(1500 * kMillisecond, 2001 * kMillisecond));
  EXPECT_FALSE(history.attitude(2001 * kMillisecond));
  EXPECT_FALSE(ImuHistory().newest());
}

TEST(ImuHistory, StartsAnewAfterAGapOrWhenTheClockIsSetBack) {
  ImuHistory history = speedingUp();
  history.add({2600 * kMillisecond, 0.0, {}});
  EXPECT_FALSE(history.turn(1500 * kMillisecond, 2500 * kMillisecond));
  history.add({500 * kMillisecond, 0.0, {}});
  EXPECT_EQ(*history.newest(), 500 * kMillisecond);
}

TEST(ImuHistory, ASensorThatDoesNotKnowDownHasNoAttitude) {
  ImuHistory history;
  history.add({10 * kMillisecond, 1.0, {}});
  history.add({20 * kMillisecond, 1.0, {}});
  EXPECT_FALSE(history.attitude(15 * kMillisecond));
  EXPECT_NEAR(*history.turn(10 * kMillisecond, 20 * kMillisecond), 0.01, 1e-12);
}

}  // namespace
}  // namespace sightline::pipeline
