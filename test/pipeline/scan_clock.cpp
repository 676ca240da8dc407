#include "sightline/pipeline/scan_clock.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "scan_feed_test.h"

namespace sightline::pipeline {
namespace {

using test::at;

constexpr double kPeriod = 0.2;  // s

// Stamps of scans that a buffer lets through so often on average [s].
std::vector<double> burstStamps(double mean, int scans, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::exponential_distribution<double> pause(1.0 / mean);
  std::vector<double> stamps;
  double flush = 100.0;
  for (int i = 0; i < scans; ++i) {
    const double made = 100.0 + kPeriod * i;
    while (flush < made) flush += pause(random);
    stamps.push_back(std::max(flush, stamps.empty() ? 0.0 : stamps.back() + 0.002));
  }
  return stamps;
}

TEST(ScanClock, BelievesStampsOfASteadyScanner) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> jitter(0.0, 0.02);
  ScanClock clock;
  for (int i = 0; i < 300; ++i) {
    // With a pause of 30 s, and each tenth scan lost.
    const double pause = i > 150 ? 30.0 : 0.0;
    if (i % 10 == 3) continue;
    clock.add(at(100.0 + pause + kPeriod * i + jitter(random)));
    EXPECT_FALSE(clock.isOfArrival()) << i;
    EXPECT_FALSE(clock.sinceBefore()) << i;
  }
}

TEST(ScanClock, FindsThePeriodBehindBursts) {
  for (const double mean : {0.2, 0.5, 1.0}) {
    ScanClock clock;
    int told = 0;
    int late = 0;
    const auto stamps = burstStamps(mean, 400, 5);
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      clock.add(at(stamps[i]));
      if (i < 64) continue;
      ++late;
      const auto elapsed = clock.sinceBefore();
      if (!elapsed) continue;
      ++told;
      EXPECT_NEAR(elapsed->usual, kPeriod, 0.2 * kPeriod) << mean << ' ' << i;
      EXPECT_GE(elapsed->longest, elapsed->usual);
      EXPECT_GT(elapsed->sigma, 0.0);
    }
    EXPECT_GT(told, late * 95 / 100) << mean;
  }
}

TEST(ScanClock, KnowsAPauseFromABurst) {
  ScanClock clock;
  for (const double stamp : burstStamps(0.5, 100, 7)) clock.add(at(stamp));
  ASSERT_TRUE(clock.sinceBefore());
  clock.add(at(200.0));
  EXPECT_FALSE(clock.sinceBefore());
}

TEST(ScanClock, KnowsABurstBeforeItKnowsThePeriod) {
  ScanClock clock;
  clock.add(at(100.0));
  EXPECT_FALSE(clock.sinceBefore());
  clock.add(at(100.001));
  ASSERT_TRUE(clock.sinceBefore());
  EXPECT_GT(clock.sinceBefore()->longest, 0.5);
  clock.add(at(100.2));
  EXPECT_FALSE(clock.sinceBefore());
}

TEST(ScanClock, BridgesASingleStampThatGoesBack) {
  ScanClock clock;
  for (int i = 0; i < 40; ++i) clock.add(at(100.0 + kPeriod * i));
  clock.add(at(107.5));
  ASSERT_TRUE(clock.sinceBefore());
  EXPECT_NEAR(clock.sinceBefore()->usual, kPeriod, 0.02);
}

using StampsOfArrival = test::ScanFeedTest;

TEST_F(StampsOfArrival, CostNoScanAndKeepTheOrder) {
  start({}, {false, false});
  auto stamps = burstStamps(1.0, 200, 3);
  // Within each burst they come in any order.
  std::mt19937_64 random(2);
  for (std::size_t i = 100; i + 4 < stamps.size(); i += 4) {
    std::shuffle(stamps.begin() + static_cast<std::ptrdiff_t>(i),
                 stamps.begin() + static_cast<std::ptrdiff_t>(i + 4), random);
  }
  std::vector<double> came;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    feed_->add(0, test::sweep(stamps[i], 0.0), at(100.0 + kPeriod * static_cast<double>(i)));
    for (const auto& result : rest()) {
      if (result.located) came.push_back(1e-9 * static_cast<double>(result.stamp));
    }
  }
  ASSERT_EQ(came.size(), stamps.size());
  for (std::size_t i = 0; i < came.size(); ++i) EXPECT_NEAR(came[i], stamps[i], 1e-6);
}

}  // namespace
}  // namespace sightline::pipeline
