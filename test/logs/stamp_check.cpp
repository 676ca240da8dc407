#include "sightline/logs/stamp_check.h"

#include <gtest/gtest.h>

namespace sightline::logs {
namespace {

constexpr std::int64_t kFirst = 1'000'000'000'000;
constexpr std::int64_t kScanPeriod = 100'000'000;

StampCheck evenStamps(int count) {
  StampCheck check;
  for (int i = 0; i < count; ++i)
    check.add(kFirst + i * kScanPeriod, kFirst + i * kScanPeriod + kScanPeriod / 2);
  return check;
}

TEST(StampCheck, EvenStampsHaveNothingAmiss) {
  const StampSummary summary = evenStamps(100).summary();
  EXPECT_EQ(summary.messages, 100U);
  EXPECT_NEAR(summary.period, 0.1, 1e-9);
  EXPECT_NEAR(summary.delay, 0.05, 1e-9);
  EXPECT_EQ(summary.back + summary.repeated + summary.gaps + summary.far, 0U);
  EXPECT_EQ(summary.in_bursts, 0.0);
}

TEST(StampCheck, CountsWhatIsAmiss) {
  StampCheck check = evenStamps(50);
  const std::int64_t last = kFirst + 49 * kScanPeriod;
  check.add(last, last);                     // repeated
  check.add(last - kScanPeriod, last);       // back
  check.add(0, last);                        // none, and back
  check.add(last + 3600'000'000'000, last);  // an hour ahead, after a gap
  const StampSummary summary = check.summary();
  EXPECT_EQ(summary.repeated, 1U);
  EXPECT_EQ(summary.back, 2U);
  EXPECT_EQ(summary.without_stamp, 1U);
  EXPECT_EQ(summary.far, 1U);
  EXPECT_EQ(summary.gaps, 1U);
}

TEST(StampCheck, FindsThePeriodBehindBursts) {
  StampCheck check;
  for (int i = 0; i < 200; ++i) {
    const std::int64_t flushed = kFirst + (i / 4 * 4 + 4) * kScanPeriod + i % 4 * 1'000'000;
    check.add(flushed, flushed);
  }
  const StampSummary summary = check.summary();
  EXPECT_NEAR(summary.period, 0.1, 0.02);
  EXPECT_NEAR(summary.in_bursts, 0.75, 0.02);
}

TEST(StampCheck, OfNoneOrOneMessageIsEmpty) {
  EXPECT_EQ(StampCheck().summary().period, 0.0);
  EXPECT_EQ(evenStamps(1).summary().period, 0.0);
}

}  // namespace
}  // namespace sightline::logs
