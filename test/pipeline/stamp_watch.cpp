#include "sightline/pipeline/stamp_watch.h"

#include <gtest/gtest.h>

namespace sightline::pipeline {
namespace {

using Verdict = StampWatch::Verdict;

constexpr std::int64_t kSecond = 1'000'000'000;

class StampWatchTest : public testing::Test {
 protected:
  // The next message, a tenth of a second later, with a stamp that is off by so much [s].
  Verdict next(double off = 0.0) {
    time_ += kSecond / 10;
    return watch_.judge(100 * kSecond + time_ + static_cast<std::int64_t>(off * kSecond), time_);
  }

  StampWatch watch_;
  std::int64_t time_ = 0;
};

TEST_F(StampWatchTest, TakesWhatGoesOn) {
  for (int i = 0; i < 50; ++i) EXPECT_EQ(next(i % 2 == 0 ? 0.02 : -0.02), Verdict::kGood);
}

TEST_F(StampWatchTest, LeavesStraysOut) {
  next();
  for (const double off : {-402.0, 3600.0, -50.0, 1e6}) {
    EXPECT_EQ(next(off), Verdict::kStray);
    EXPECT_NEAR(watch_.leap(100 * kSecond + time_), 0.1, 1e-9) << "the last good one is kept";
    EXPECT_EQ(next(), Verdict::kGood);
  }
}

TEST_F(StampWatchTest, StraysThatFollowEachOtherAreANewTime) {
  double off = 0.0;
  for (const double step : {-20.0, -3600.0, 3600.0, -5.0}) {
    EXPECT_EQ(next(off), Verdict::kGood);
    off += step;
    EXPECT_EQ(next(off), Verdict::kStray) << step;
    EXPECT_EQ(next(off), Verdict::kStray);
    EXPECT_EQ(next(off), Verdict::kClockSet);
    EXPECT_EQ(next(off), Verdict::kGood);
  }
}

TEST_F(StampWatchTest, TakesBurstsAndFastPlayers) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(watch_.judge(100 * kSecond + i * kSecond / 10, 0), Verdict::kGood) << "all at once";
  }
  StampWatch fast;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(fast.judge(100 * kSecond + i * kSecond, i * kSecond / 10), Verdict::kGood);
  }
}

TEST(FaultOfStamp, NamesStampsThatNobodyCanUse) {
  EXPECT_EQ(faultOfStamp(100 * kSecond), "");
  EXPECT_EQ(faultOfStamp(0), "a stamp of zero");
  EXPECT_EQ(faultOfStamp(4294967295LL * kSecond), "a stamp of 4294967295 s, out of range");
}

}  // namespace
}  // namespace sightline::pipeline
