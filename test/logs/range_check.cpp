#include "sightline/logs/range_check.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace sightline::logs {
namespace {

constexpr std::size_t kBeams = 90;
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A scene that changes from scan to scan.
std::vector<float> sceneAt(int scan) {
  std::mt19937 random(static_cast<unsigned>(scan));
  std::uniform_real_distribution<float> range(1.0F, 7.0F);
  std::vector<float> ranges(kBeams);
  for (float& value : ranges) value = range(random);
  return ranges;
}

template <class Edit>
RangeSummary summaryOf(const Edit& edit, double range_max = 8.0) {
  RangeCheck check;
  for (int scan = 0; scan < 50; ++scan) {
    auto ranges = sceneAt(scan);
    edit(ranges);
    check.add(ranges, 0.1, range_max);
  }
  return check.summary();
}

TEST(RangeCheck, SortsReadings) {
  const RangeSummary summary = summaryOf([](std::vector<float>& ranges) {
    ranges[0] = kInf;
    ranges[1] = 9.0F;
    ranges[2] = kNan;
    ranges[3] = 0.0F;
    ranges[4] = 0.05F;
    ranges[5] = -kInf;
  });
  EXPECT_EQ(summary.scans, 50U);
  EXPECT_EQ(summary.beams, kBeams);
  EXPECT_NEAR(summary.valid, 84.0 / 90.0, 1e-9);
  EXPECT_NEAR(summary.nothing, 2.0 / 90.0, 1e-9);
  EXPECT_NEAR(summary.not_a_number, 1.0 / 90.0, 1e-9);
  EXPECT_NEAR(summary.zero, 1.0 / 90.0, 1e-9);
  EXPECT_NEAR(summary.too_near, 2.0 / 90.0, 1e-9);
}

TEST(RangeCheck, FindsMissesThatComeAsRanges) {
  const auto miss = [](float value) {
    return [value](std::vector<float>& ranges) { ranges[7] = ranges[40] = value; };
  };
  EXPECT_TRUE(summaryOf(miss(8.0F)).misses_as_ranges);
  EXPECT_TRUE(summaryOf(miss(7.95F)).misses_as_ranges);
  EXPECT_FALSE(summaryOf(miss(kInf)).misses_as_ranges);
  EXPECT_NEAR(summaryOf(miss(7.95F)).largest, 7.95, 1e-6);
}

TEST(RangeCheck, FindsTheStepOfTheRanges) {
  const auto rounded = [](double step) {
    return [step](std::vector<float>& ranges) {
      for (float& range : ranges) range = static_cast<float>(step * std::round(range / step));
    };
  };
  EXPECT_EQ(summaryOf(rounded(0.05)).resolution, 0.05);
  EXPECT_EQ(summaryOf(rounded(0.01)).resolution, 0.01);
  EXPECT_EQ(summaryOf([](std::vector<float>&) {}).resolution, 0.0);
}

TEST(RangeCheck, FindsTheRobotsOwnBody) {
  const RangeSummary summary = summaryOf([](std::vector<float>& ranges) {
    for (std::size_t beam = 10; beam < 15; ++beam) ranges[beam] = 0.3F;
    ranges[60] = 0.25F;
  });
  ASSERT_EQ(summary.constant.size(), 2U);
  EXPECT_EQ(summary.constant[0].first, 10U);
  EXPECT_EQ(summary.constant[0].last, 14U);
  EXPECT_EQ(summary.constant[1].first, 60U);
}

TEST(RangeCheck, CallsNothingItsBodyWhileItStands) {
  RangeCheck check;
  for (int scan = 0; scan < 50; ++scan) check.add(sceneAt(0), 0.1, 8.0);
  EXPECT_TRUE(check.summary().constant.empty());
}

}  // namespace
}  // namespace sightline::logs
