// What the feed makes of stamps, odometry and sweeps as other people's robots publish them.
#include <gmock/gmock.h>

#include "scan_feed_test.h"

namespace sightline::pipeline {
namespace {

using test::at;
using test::ScanFeedTest;
using testing::Contains;
using testing::Pair;

TEST_F(ScanFeedTest, LeavesOutStraysByReason) {
  start({}, {true, false});
  transforms_.mount("laser", geometry::Pose2());
  double now = 1000.0;
  for (const double off : {0.0, -402.0, 0.0, 3600.0, 0.0}) {
    now += 0.1;
    feed_->add(0, test::sweep(now + off), at(now));
  }
  feed_->add(0, test::sweep(0.0), at(now));
  feed_->add(0, test::sweep(4294967295.0), at(now));
  EXPECT_EQ(all(now).size(), 7U);
  const FeedCounts& counts = feed_->counts(0);
  EXPECT_EQ(counts.located, 3U);
  EXPECT_THAT(counts.dropped, Contains(Pair("a stamp far behind the ones before it", 1U)));
  EXPECT_THAT(counts.dropped, Contains(Pair("a stamp far ahead of the ones before it", 1U)));
  EXPECT_THAT(counts.dropped, Contains(Pair("a stamp of zero", 1U)));
  EXPECT_THAT(counts.dropped, Contains(Pair("a stamp of 4294967295 s, out of range", 1U)));
}

TEST_F(ScanFeedTest, AClockThatIsSetForwardIsANewTime) {
  start({}, {true, false});
  transforms_.mount("laser", geometry::Pose2());
  feed_->add(0, test::sweep(10.0), at(10.1));
  for (int i = 1; i <= 3; ++i) feed_->add(0, test::sweep(3610.0 + 0.1 * i), at(10.1 + 0.1 * i));
  const auto results = all(10.5);
  ASSERT_EQ(results.size(), 4U);
  EXPECT_TRUE(results[1].located->clock_restarted);
  EXPECT_FALSE(results[2].located->clock_restarted);
}

TEST_F(ScanFeedTest, ShiftsStampsByTheOffset) {
  FeedConfig config;
  config.time_offset = -0.1;
  start(config, {true, false});
  transforms_.mount("laser", geometry::Pose2());
  feed_->add(0, test::sweep(10.0), at(10.1));
  const auto results = all(10.2);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].located->scan.stamp, at(9.9));
}

TEST_F(ScanFeedTest, ScanWithTheStampOfTheOneBeforeIsLeftOut) {
  start({}, {true, false});
  transforms_.mount("laser", geometry::Pose2());
  for (int i = 0; i < 2; ++i) feed_->add(0, test::sweep(10.0), at(10.1 + 0.1 * i));
  feed_->add(1, test::sweep(10.0), at(10.3));
  const auto results = all(10.4);
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[1].reason, "the stamp of the scan before it");
  EXPECT_TRUE(results[2].located) << "another scanner's";
}

TEST_F(ScanFeedTest, BridgesABreakAndDropsTheMotionOfItsSweep) {
  start();
  transforms_.mount("laser", geometry::Pose2());
  for (int i = 0; i <= 50; ++i) {
    const double time = 10.0 + 0.02 * i;
    const double leap = time > 10.41 ? 30.0 : 0.0;
    transforms_.drive(at(time), geometry::Pose2(leap + 0.5 * (time - 10.0), 0.0, 0.0));
  }
  for (int i = 1; i <= 6; ++i) feed_->add(0, test::sweep(10.0 + 0.1 * i, 0.05), at(11.0));
  const auto results = all(11.0);
  ASSERT_EQ(results.size(), 6U);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const LocatedScan& located = *results[i].located;
    const double time = 0.1 * static_cast<double>(i + 1);
    EXPECT_NEAR(located.T_path_base->x(), 0.5 * time, 0.01) << i;
    EXPECT_EQ(located.odometry_broke, i == 4) << i;
    EXPECT_EQ(located.motion_known, i != 3) << i;
  }
  EXPECT_EQ(feed_->counts(0).odometry_broke, 1U);
}

// The second scanner's scans arrive 80 ms after their stamps, after the next one of the first.
TEST_F(ScanFeedTest, ScansOfSeveralScannersComeInOrderAlsoWhereOneIsLate) {
  start();
  transforms_.mount("laser", geometry::Pose2());
  drive(9.9, 12.0);
  std::vector<std::int64_t> stamps;
  const auto deliver = [&](double now) {
    for (const FeedResult& result : all(now)) stamps.push_back(result.stamp);
  };
  double longest = 0.0;
  for (int i = 0; i < 16; ++i) {
    const double time = 10.0 + 0.1 * i;
    feed_->add(0, test::sweep(time, 0.0), at(time));
    deliver(time);
    // The second scanner falls silent in the end.
    if (i > 0 && i < 12) feed_->add(1, test::sweep(time - 0.05, 0.0), at(time + 0.03));
    deliver(time + 0.03);
    deliver(time + 0.07);
    longest = std::max(longest, time - 1e-9 * static_cast<double>(stamps.back()));
  }
  EXPECT_EQ(stamps.size(), 27U);
  const auto in_order = std::is_sorted(stamps.begin() + 4, stamps.end());
  EXPECT_TRUE(in_order);
  EXPECT_LT(longest, 0.15) << "a scanner that is gone is not waited for";
}

TEST_F(ScanFeedTest, OdometryThatLeapsInTimeIsLeftOut) {
  start();
  const auto add = [this](double stamp, double now) {
    return feed_->addOdometry(at(stamp), geometry::Pose2(), at(now));
  };
  EXPECT_EQ(add(10.0, 10.0), "");
  EXPECT_EQ(add(3610.0, 10.1), "a stamp far ahead of the ones before it");
  EXPECT_EQ(add(10.2, 10.2), "");
  EXPECT_EQ(add(0.0, 10.3), "a stamp of zero");
  EXPECT_EQ(add(10.15, 10.4), "") << "late, within a second";
}

}  // namespace
}  // namespace sightline::pipeline
