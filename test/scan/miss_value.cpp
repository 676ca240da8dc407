#include "sightline/scan/miss_value.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sightline/geometry/angle.h"

namespace sightline::scan {
namespace {

constexpr std::size_t kBeams = 360;

// A wall at 2 m ahead and to all sides of a square, with noise, counted in steps.
std::vector<double> squareRoom(double noise, double step, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double angle = geometry::radians(static_cast<double>(i) - 180.0);
    const double exact = 2.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    const double range = exact + noise * normal(random);
    ranges.push_back(step > 0.0 ? step * std::round(range / step) : range);
  }
  return ranges;
}

Scan scanOf(const std::vector<double>& ranges, double range_max = 10.0) {
  const auto geometry =
      ScanGeometry::uniform(-geometry::kPi, geometry::radians(1.0), kBeams, 0.0, 0.05, range_max);
  return {geometry, 1, ranges};
}

std::size_t misses(const Scan& scan) {
  return static_cast<std::size_t>(
      std::count(scan.kinds().begin(), scan.kinds().end(), ReturnKind::kNothing));
}

TEST(MissValue, WallsAreNoMisses) {
  for (const double noise : {0.0, 0.001, 0.01, 0.03}) {
    for (const double step : {0.0, 0.001, 0.01, 0.05}) {
      MissValue value;
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Scan scan = scanOf(squareRoom(noise, step, seed));
        value.mark(scan);
        EXPECT_EQ(misses(scan), 0U) << noise << " " << step;
      }
    }
  }
}

TEST(MissValue, FindsTheLargestValueOfManyBeams) {
  for (const double step : {0.0, 0.001, 0.01}) {
    for (const double reported : {2.3, 2.25}) {
      auto ranges = squareRoom(0.01, step);
      std::size_t beyond = 0;
      for (double& range : ranges) {
        if (range < 2.2) continue;
        range = reported;
        ++beyond;
      }
      MissValue value;
      Scan scan = scanOf(ranges, 2.3);
      value.mark(scan);
      EXPECT_EQ(misses(scan), beyond) << step;
      EXPECT_THAT(value.values(), testing::ElementsAre(reported));
    }
  }
}

TEST(MissValue, RemembersItWhereOnlyFewBeamsMiss) {
  auto ranges = squareRoom(0.01, 0.0);
  std::fill(ranges.begin() + 100, ranges.begin() + 140, 5.0);
  MissValue value;
  Scan scan = scanOf(ranges);
  value.mark(scan);
  EXPECT_EQ(misses(scan), 40U);
  ranges = squareRoom(0.01, 0.0, 2);
  ranges[17] = 5.0;
  scan = scanOf(ranges);
  value.mark(scan);
  EXPECT_EQ(misses(scan), 1U);
}

TEST(MissValue, FindsMissesBetweenReturns) {
  auto ranges = squareRoom(0.01, 0.0);
  for (std::size_t i = 0; i < kBeams; i += 7) ranges[i] = 5.0;
  MissValue value;
  Scan scan = scanOf(ranges);
  value.mark(scan);
  EXPECT_EQ(misses(scan), 52U);
}

TEST(MissValue, ForgetsAValueThatBeamsPass) {
  auto ranges = squareRoom(0.01, 0.0);
  std::fill(ranges.begin(), ranges.begin() + 40, 3.0);
  MissValue value;
  Scan scan = scanOf(ranges);
  value.mark(scan);
  ASSERT_EQ(misses(scan), 40U);
  ranges = squareRoom(0.01, 0.0);
  ranges[3] = 3.0;
  ranges[4] = 4.0;
  scan = scanOf(ranges);
  value.mark(scan);
  EXPECT_EQ(misses(scan), 0U);
}

TEST(MissValue, TakesScansWithoutReturns) {
  MissValue value;
  Scan scan = scanOf(std::vector<double>(kBeams, std::nan("")));
  value.mark(scan);
  EXPECT_EQ(misses(scan), 0U);
}

}  // namespace
}  // namespace sightline::scan
