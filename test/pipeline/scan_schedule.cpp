#include "sightline/pipeline/scan_schedule.h"

#include <gtest/gtest.h>

namespace sightline::pipeline {
namespace {

constexpr std::int64_t kMilli = 1'000'000;

TEST(ScanSchedule, AwaitsWhatIsDueBeforeAStampAndNotLate) {
  ScanSchedule schedule;
  EXPECT_FALSE(schedule.awaits(0, 0)) << "nothing is known";
  schedule.add(0, 80 * kMilli);
  EXPECT_FALSE(schedule.awaits(500 * kMilli, 90 * kMilli)) << "no period is known";
  schedule.add(100 * kMilli, 180 * kMilli);
  // The next bears 200 ms and comes at 280.
  EXPECT_TRUE(schedule.awaits(250 * kMilli, 255 * kMilli));
  EXPECT_TRUE(schedule.awaits(250 * kMilli, 300 * kMilli)) << "a little late";
  EXPECT_FALSE(schedule.awaits(250 * kMilli, 310 * kMilli)) << "it does not come";
  EXPECT_FALSE(schedule.awaits(200 * kMilli, 255 * kMilli)) << "not before it";
  EXPECT_FALSE(schedule.awaits(150 * kMilli, 255 * kMilli));
}

TEST(ScanSchedule, ForeseesNothingAfterAGap) {
  ScanSchedule schedule;
  schedule.add(0, 0);
  schedule.add(3000 * kMilli, 3000 * kMilli);
  EXPECT_FALSE(schedule.awaits(10'000 * kMilli, 3010 * kMilli));
  schedule.add(2000 * kMilli, 3100 * kMilli);
  EXPECT_FALSE(schedule.awaits(10'000 * kMilli, 3110 * kMilli)) << "the clock was set back";
}

}  // namespace
}  // namespace sightline::pipeline
