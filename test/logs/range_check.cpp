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

scan::Scan scanOf(const std::vector<float>& ranges) {
  static const auto kGeometry =
      scan::ScanGeometry::uniform(-1.5, 3.0 / (kBeams - 1), kBeams, 0.0, 0.1, 8.0);
  return scan::Scan(kGeometry, 0, {ranges.begin(), ranges.end()});
}

template <class Edit>
RangeSummary summaryOf(const Edit& edit) {
  RangeCheck check;
  for (int scan = 0; scan < 50; ++scan) {
    auto ranges = sceneAt(scan);
    edit(ranges);
    check.add(scanOf(ranges));
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
  EXPECT_NEAR(summary.invalid, 2.0 / 90.0, 1e-9);
  EXPECT_NEAR(summary.too_near, 2.0 / 90.0, 1e-9);
}

TEST(RangeCheck, FindsTheStepOfTheRanges) {
  const auto rounded = [](double step) {
    return [step](std::vector<float>& ranges) {
      for (float& range : ranges) range = static_cast<float>(step * std::round(range / step));
    };
  };
  EXPECT_NEAR(summaryOf(rounded(0.05)).step, 0.05, 1e-4);
  EXPECT_NEAR(summaryOf(rounded(0.01)).step, 0.01, 1e-4);
  EXPECT_EQ(summaryOf([](std::vector<float>&) {}).step, 0.0);
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
  for (int scan = 0; scan < 50; ++scan) check.add(scanOf(sceneAt(0)));
  EXPECT_TRUE(check.summary().constant.empty());
}

}  // namespace
}  // namespace sightline::logs
