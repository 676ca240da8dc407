#include "sightline/pipeline/repeat_watch.h"

#include <limits>

#include <gtest/gtest.h>

namespace sightline::pipeline {
namespace {

using geometry::Pose2;

scan::Scan scanOf(double range, std::size_t returns = 50, std::int64_t stamp = 0) {
  const auto geometry = scan::ScanGeometry::uniform(-1.0, 0.04, 50, 0.0, 0.1, 10.0);
  std::vector<double> ranges(50, range);
  for (std::size_t i = returns; i < 50; ++i) ranges[i] = std::numeric_limits<double>::quiet_NaN();
  return scan::Scan(geometry, stamp, ranges);
}

scan::RangeNoise noiseOf(double sigma, double step = 0.0) {
  scan::RangeNoise noise;
  noise.sigma = sigma;
  noise.step = step;
  noise.is_learned = true;
  return noise;
}

TEST(RepeatWatch, NoiseTellsARepetition) {
  const scan::RangeNoise noise = noiseOf(0.01);
  RepeatWatch watch;
  EXPECT_FALSE(watch.isRepeat(scanOf(2.0), &noise, {}));
  EXPECT_TRUE(watch.isRepeat(scanOf(2.0), &noise, {}));
  EXPECT_TRUE(watch.isRepeat(scanOf(2.0), &noise, {}));
  EXPECT_FALSE(watch.isRepeat(scanOf(2.001), &noise, {}));
}

TEST(RepeatWatch, WithoutNoiseOnlyMotionTells) {
  const scan::RangeNoise none = noiseOf(1e-7);
  const scan::RangeNoise coarse = noiseOf(0.015, 0.05);
  for (const scan::RangeNoise* noise :
       {&none, &coarse, static_cast<const scan::RangeNoise*>(nullptr)}) {
    RepeatWatch watch;
    EXPECT_FALSE(watch.isRepeat(scanOf(2.0), noise, Pose2()));
    EXPECT_FALSE(watch.isRepeat(scanOf(2.0), noise, Pose2()));
    EXPECT_FALSE(watch.isRepeat(scanOf(2.0), noise, Pose2(0.06, 0.0, 0.0)));
    EXPECT_TRUE(watch.isRepeat(scanOf(2.0), noise, Pose2(0.12, 0.0, 0.0)));
    EXPECT_FALSE(watch.isRepeat(scanOf(2.1), noise, Pose2(0.12, 0.0, 0.0)));
  }
}

// Odometry that drifts by 2 cm/s while a scanner without noise stands.
TEST(RepeatWatch, DriftOfARobotThatStandsIsNoMotion) {
  RepeatWatch watch;
  for (int i = 0; i < 200; ++i) {
    const std::int64_t stamp = 100'000'000 * static_cast<std::int64_t>(i);
    EXPECT_FALSE(watch.isRepeat(scanOf(2.0, 50, stamp), nullptr, Pose2(0.002 * i, 0.0, 0.0))) << i;
  }
}

TEST(RepeatWatch, AFewReturnsMayBeTheSameByChance) {
  const scan::RangeNoise noise = noiseOf(0.01);
  RepeatWatch watch;
  EXPECT_FALSE(watch.isRepeat(scanOf(2.0, 20), &noise, {}));
  EXPECT_FALSE(watch.isRepeat(scanOf(2.0, 20), &noise, {}));
}

}  // namespace
}  // namespace sightline::pipeline
