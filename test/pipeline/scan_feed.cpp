#include "scan_feed_test.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace sightline::pipeline {
namespace {

using geometry::Pose2;
using test::at;
using test::ScanFeedTest;
using test::sweep;
using testing::Contains;
using testing::Pair;

// 361 beams at a wall two metres ahead, with noise; every third beam of a cluttered scan sees
// something nearer.
scan::Scan wallAhead(double stamp, double sigma, bool is_cluttered, std::mt19937& random) {
  const auto geometry = scan::ScanGeometry::uniform(-1.2, 2.4 / 360.0, 361, 0.0, 0.1, 10.0);
  std::normal_distribution<double> noise(0.0, sigma);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < geometry->beams(); ++i) {
    const double to_wall = 2.0 / geometry->cosines()[i] + noise(random);
    const bool is_near = is_cluttered && i % 3 == 0;
    ranges.push_back(is_near ? 0.1 + 0.5 * to_wall : to_wall);
  }
  return {geometry, at(stamp), std::move(ranges)};
}

// Sigma of the first beam of a scan that went through the feed.
double sigmaOf(const std::vector<FeedResult>& results) {
  return std::sqrt(results.at(0).located->scan.rangeVariances().front());
}

TEST_F(ScanFeedTest, LearnsTheNoiseOfEachScannerAndKeepsIt) {
  start({}, FeedNeeds{false, false});
  std::mt19937 random(1);
  EXPECT_EQ(feed_->learnedNoise(0), nullptr);
  for (int i = 0; i < 20; ++i) {
    for (const std::size_t scanner : {0, 1}) {
      const double stamp = 10.0 + 0.1 * i;
      feed_->add(scanner, wallAhead(stamp, scanner == 0 ? 0.01 : 0.03, false, random), at(stamp));
      const auto results = all(stamp);
      if (i < 19) continue;
      EXPECT_NEAR(sigmaOf(results), scanner == 0 ? 0.01 : 0.03, 0.003);
    }
  }
  ASSERT_NE(feed_->learnedNoise(0), nullptr);
  const scan::RangeNoise learned = *feed_->learnedNoise(0);
  feed_->add(0, wallAhead(12.0, 0.01, true, random), at(12.0));
  const auto results = all(12.0);
  const double range = results.at(0).located->scan.ranges().front();
  EXPECT_DOUBLE_EQ(sigmaOf(results), std::sqrt(learned.variance(range)));
}

TEST_F(ScanFeedTest, GoesOnWithoutWhatDoesNotComeInTime) {
  FeedConfig config;
  config.patience = 0.3;
  start(config);
  transforms_.mount("laser", Pose2());
  drive(9.0, 9.6);
  feed_->add(0, sweep(10.2), at(10.3));
  EXPECT_TRUE(all(10.5).empty());
  const auto results = all(10.61);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_FALSE(results[0].located->T_odom_base);
  EXPECT_FALSE(results[0].located->motion_known);
  EXPECT_EQ(results[0].located->no_odometry, "no odometry from odom to base_link at its time");
  EXPECT_EQ(feed_->counts(0).without_motion, 1U);
}

TEST_F(ScanFeedTest, DoesNotWaitForOdometryThatBeganLater) {
  start();
  transforms_.mount("laser", Pose2());
  drive(10.0, 10.5);
  feed_->add(0, sweep(9.9), at(10.5));
  const auto results = all(10.5);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_TRUE(results[0].located->before_odometry);
}

// Odometry that another thread brings between two questions is not odometry that began later.
TEST_F(ScanFeedTest, OdometryThatComesWhileItIsAskedForIsWaitedForOrTaken) {
  for (int questions = 0; questions < 8; ++questions) {
    transforms_ = {};
    start();
    transforms_.mount("laser", Pose2());
    drive(10.0, 10.15);
    feed_->add(0, sweep(10.1), at(10.2));
    std::function<void(int)> bring = [&](int left) {
      if (left == 0) drive(10.2, 10.3);
      if (left > 0) transforms_.afterNextQuestion([&bring, left] { bring(left - 1); });
    };
    transforms_.afterNextQuestion([&] { bring(questions); });
    auto results = all(10.25);
    if (results.empty()) results = all(10.26);
    if (results.empty()) continue;  // not yet brought
    ASSERT_EQ(results.size(), 1U) << questions;
    EXPECT_FALSE(results[0].located->before_odometry) << questions;
    EXPECT_TRUE(results[0].located->T_odom_base) << questions;
  }
}

TEST_F(ScanFeedTest, WaitsOnceForWhatNeverCame) {
  start();
  feed_->add(0, sweep(10.0), at(10.1));
  feed_->add(0, sweep(10.1), at(10.2));
  EXPECT_TRUE(all(11.9).empty());
  EXPECT_EQ(all(12.2).size(), 2U) << "the second does not wait again";
  feed_->add(0, sweep(12.2), at(12.3));
  const auto results = all(12.3);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_FALSE(results[0].located->T_base_sensor);
  EXPECT_EQ(results[0].located->no_odometry, "no transform from base_link to laser at its time");
}

TEST_F(ScanFeedTest, KeepsTheOrderOfTheStampsWhileScansWait) {
  start();
  transforms_.mount("laser", Pose2());
  drive(10.0, 10.1);
  feed_->add(0, sweep(10.2), at(10.3));
  feed_->add(1, sweep(10.15), at(10.31));
  drive(10.15, 10.4);
  const auto results = all(10.4);
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0].scanner, 1U);
  feed_->add(1, sweep(10.1), at(10.4));
  const auto late = all(10.4);
  ASSERT_EQ(late.size(), 1U);
  EXPECT_EQ(late[0].reason, "older than the scan before it");
  EXPECT_THAT(feed_->counts(1).dropped, Contains(Pair("older than the scan before it", 1U)));
}

TEST_F(ScanFeedTest, StartsAgainWhereTheClockIsSetBack) {
  start({}, {true, false});
  transforms_.mount("laser", Pose2());
  feed_->add(0, sweep(100.0), at(1.0));
  feed_->add(0, sweep(10.0), at(1.1));
  feed_->add(0, sweep(10.1), at(1.2));
  feed_->add(0, sweep(10.2), at(1.3));
  const auto results = all(1.3);
  ASSERT_EQ(results.size(), 4U);
  EXPECT_FALSE(results[0].located->clock_restarted);
  EXPECT_TRUE(results[1].located->clock_restarted);
  EXPECT_FALSE(results[2].located->clock_restarted);
}

TEST_F(ScanFeedTest, ScansOfTheOldTimeDoNotHoldUpThoseOfTheNew) {
  start();
  transforms_.mount("laser", Pose2());
  drive(99.0, 100.0);
  feed_->add(0, sweep(99.5), at(0.9));
  EXPECT_EQ(all(0.9).size(), 1U);
  feed_->add(0, sweep(100.0), at(1.0));  // the odometry ends at its stamp
  EXPECT_TRUE(all(1.0).empty());
  for (int i = 0; i < 3; ++i) feed_->add(0, sweep(10.0 + 0.1 * i), at(1.1 + 0.1 * i));
  const auto results = all(1.3);
  ASSERT_GE(results.size(), 2U);
  EXPECT_EQ(results[0].stamp, at(100.0));
  EXPECT_TRUE(results[1].located->clock_restarted);
}

TEST_F(ScanFeedTest, WaitsForAnInertialSensorThatHasBeenComing) {
  start({}, {true, false});
  transforms_.mount("laser", Pose2());
  feed_->addImu({at(10.0), 0.5, {}}, at(10.0));
  feed_->add(0, sweep(10.1), at(10.2));
  EXPECT_TRUE(all(10.3).empty());
  feed_->addImu({at(10.25), 0.5, {}}, at(10.25));
  EXPECT_EQ(all(10.3).size(), 1U);
}

TEST_F(ScanFeedTest, CountsWhatWasNoScan) {
  start();
  feed_->refuse(0, "no beams");
  EXPECT_EQ(feed_->counts(0).arrived, 1U);
  EXPECT_THAT(feed_->counts(0).dropped, Contains(Pair("no beams", 1U)));
}

}  // namespace
}  // namespace sightline::pipeline
