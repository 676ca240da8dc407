#include "scan_feed_test.h"

#include <gmock/gmock.h>

namespace sightline::pipeline {
namespace {

using geometry::Pose2;
using test::at;
using test::ScanFeedTest;
using test::sweep;

TEST_F(ScanFeedTest, WaitsUntilTheOdometryCoversTheSweep) {
  start();
  transforms_.mount("laser", Pose2(0.2, 0.0, 0.0));
  drive(10.0, 10.15);
  feed_->add(0, sweep(10.1), at(10.2));
  EXPECT_TRUE(all(10.2).empty());
  drive(10.2, 10.25);
  const auto results = all(10.25);
  ASSERT_EQ(results.size(), 1U);
  const LocatedScan& located = *results[0].located;
  EXPECT_NEAR(located.T_odom_base->x(), 0.1, 1e-9);
  EXPECT_NEAR(located.T_base_sensor->x(), 0.2, 1e-12);
  EXPECT_TRUE(located.motion_known);
  EXPECT_TRUE(located.no_odometry.empty());
  ASSERT_EQ(located.scan.sensorMotion().size(), 11U);
  EXPECT_NEAR(located.scan.sensorMotion().back().x(), 0.1, 1e-6);
  EXPECT_GT(located.scan.motion_noise.walk(0, 0), 0.0);
}

// The velocity is that of a moment ago; where the robot is at the stamp nobody knows.
TEST_F(ScanFeedTest, TheMotionOfAMomentAgoServesWhereOdometryLags) {
  start();
  transforms_.mount("laser", Pose2());
  drive(9.0, 10.15);
  feed_->add(0, sweep(10.2), at(10.3));
  const auto results = all(10.9);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_FALSE(results[0].located->T_odom_base);
  EXPECT_TRUE(results[0].located->motion_known);
  EXPECT_NEAR(results[0].located->scan.sensorMotion().back().x(), 0.1, 1e-6);
}

TEST_F(ScanFeedTest, AsksNobodyWhereNothingIsNeeded) {
  start({}, {false, false});
  feed_->add(0, sweep(10.0), at(10.1));
  const auto results = all(10.1);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_TRUE(results[0].located->scan.sensorMotion().empty());
}

TEST_F(ScanFeedTest, MirrorsWhatHangsUpsideDown) {
  start();
  transforms_.mount("laser", Eigen::Isometry3d(Eigen::Translation3d(0.2, 0.1, 0.5) *
                                               Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX())));
  drive(10.0, 10.3);
  feed_->add(0, sweep(10.1), at(10.3));
  const auto results = all(10.3);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_TRUE(results[0].located->upside_down);
  EXPECT_NEAR(results[0].located->scan.geometry()->angles().front(), 0.5, 1e-12);
  EXPECT_NEAR(results[0].located->T_base_sensor->y(), 0.1, 1e-12);
  EXPECT_NEAR(results[0].located->T_base_sensor->theta(), 0.0, 1e-12);
  EXPECT_NEAR(results[0].located->scan.sensorMotion().back().x(), 0.1, 1e-6);
}

TEST_F(ScanFeedTest, RefusesAPlaneThatIsNotLevel) {
  start();
  transforms_.mount("laser", Eigen::Isometry3d(Eigen::Quaterniond(-0.5, 0.5, -0.5, 0.5)));
  drive(10.0, 10.3);
  feed_->add(0, sweep(10.1), at(10.3));
  const auto results = all(10.3);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].reason,
            "its plane is not level: laser is tilted by 90 degrees in base_link");
}

// Against transforms taken beam by beam: a base that drives an arc under a turret that turns.
TEST_F(ScanFeedTest, ATurretAndADrivingRobotAreOneMotion) {
  start();
  const auto T_odom_base = [](double time) {
    return Pose2::exp((time - 10.0) * Eigen::Vector3d(0.5, 0.0, 0.8));
  };
  const auto T_base_sensor = [](double time) {
    return Pose2(0.2, 0.1, 0.0) * Pose2(0.0, 0.0, 1.5 * (time - 10.0)) * Pose2(0.05, 0.0, 0.0);
  };
  for (double time = 10.0; time < 10.4; time += 0.002) {
    transforms_.drive(at(time), T_odom_base(time));
    transforms_.turret("laser", at(time), T_base_sensor(time));
  }
  feed_->add(0, sweep(10.1, 0.2), at(10.4));
  const auto results = all(10.4);
  ASSERT_EQ(results.size(), 1U);
  const LocatedScan& located = *results[0].located;
  const Pose2 T_odom_start = T_odom_base(10.1) * T_base_sensor(10.1);
  for (std::size_t beam = 0; beam < 11; ++beam) {
    const double time = 10.1 + 0.02 * static_cast<double>(beam);
    const Pose2 expected = geometry::between(T_odom_start, T_odom_base(time) * T_base_sensor(time));
    const Pose2 error = geometry::between(expected, located.scan.sensorMotion()[beam]);
    EXPECT_LT(error.translation().norm(), 1e-5) << beam;
    EXPECT_LT(std::abs(error.theta()), 1e-5) << beam;
  }
}

// The same head, told by the scan itself and not by transforms.
TEST_F(ScanFeedTest, ARangeScanBringsItsHeadAlong) {
  FeedConfig config;
  config.head_sigma = 0.002;
  start(config);
  transforms_.mount("mount", Pose2(0.2, 0.1, 0.3));
  drive(10.0, 10.4);
  motion::RangeScan range_scan{sweep(10.1, 0.1, "projection"), {}};
  range_scan.head = {{}, "mount", {0.05, -0.03}};
  for (int i = 0; i < 11; ++i) range_scan.head.angles.push_back(0.2 + 0.02 * i);
  feed_->add(0, range_scan, at(10.3));
  const auto results = all(10.3);
  ASSERT_EQ(results.size(), 1U);
  const LocatedScan& located = *results[0].located;
  const auto T_base_sensor = [&](std::size_t beam) {
    return Pose2(0.2, 0.1, 0.3) * range_scan.head.T_mount_sensor(beam);
  };
  EXPECT_NEAR(located.T_base_sensor->theta(), 0.5, 1e-12);
  for (std::size_t beam = 0; beam < 11; ++beam) {
    const Pose2 T_start_base(0.01 * static_cast<double>(beam), 0.0, 0.0);
    const Pose2 expected = T_base_sensor(0).inverse() * T_start_base * T_base_sensor(beam);
    EXPECT_LT((expected.coordinates() - located.scan.sensorMotion()[beam].coordinates()).norm(),
              1e-9);
  }
  EXPECT_DOUBLE_EQ(located.scan.motion_noise.jitter, 4e-6);
  EXPECT_LT((located.scan.motion_noise.jitter_axis - Eigen::Vector2d(-0.05, 0.03)).norm(), 1e-12);
}

TEST_F(ScanFeedTest, TakesTheTopicWhereTransformsKnowNoOdometry) {
  start();
  transforms_.mount("laser", Pose2(0.2, 0.0, 0.0));
  for (int i = 0; i <= 8; ++i) {
    feed_->addOdometry(at(10.0 + 0.05 * i), Pose2(0.05 * i, 0, 0), at(10.0 + 0.05 * i));
  }
  feed_->add(0, sweep(10.1), at(10.3));
  const auto results = all(10.3);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_NEAR(results[0].located->T_odom_base->x(), 0.1, 1e-9);
  EXPECT_NEAR(results[0].located->scan.sensorMotion().back().x(), 0.1, 1e-6);
}

TEST_F(ScanFeedTest, LeavesTheWheelsAloneWhereItIsTold) {
  FeedConfig config;
  config.odometry_source = OdometrySource::kNone;
  start(config);
  transforms_.mount("laser", Pose2());
  drive(10.0, 11.0);
  feed_->add(0, sweep(10.1), at(10.3));
  const auto results = all(10.3);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_FALSE(results[0].located->T_odom_base);
  EXPECT_TRUE(results[0].located->scan.sensorMotion().empty());
}

TEST_F(ScanFeedTest, TheLastKnownMountingServesWhereItIsFixed) {
  start({}, {true, false});
  transforms_.turret("laser", at(10.0), Pose2(0.2, 0.0, 0.0));
  transforms_.turret("laser", at(10.2), Pose2(0.2, 0.0, 0.0));
  feed_->add(0, sweep(10.1), at(10.3));
  feed_->add(0, sweep(10.5), at(10.6));
  EXPECT_EQ(all(10.6).size(), 1U);
  const auto results = all(11.2);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_NEAR(results[0].located->T_base_sensor->x(), 0.2, 1e-12);
}

TEST_F(ScanFeedTest, GyroscopeAndAttitudeComeWithTheScan) {
  start({}, {true, false});
  transforms_.mount("laser", Pose2());
  for (int i = 0; i <= 60; ++i) {
    feed_->addImu({at(10.0 + 0.01 * i), 0.5, geometry::Attitude{0.0, 0.1}}, at(10.0 + 0.01 * i));
  }
  feed_->add(0, sweep(10.1), at(10.3));
  feed_->add(0, sweep(10.3), at(10.5));
  const auto results = all(10.5);
  ASSERT_EQ(results.size(), 2U);
  EXPECT_FALSE(results[0].located->turn);
  EXPECT_NEAR(*results[1].located->turn, 0.1, 1e-9);
  EXPECT_NEAR(results[1].located->attitude->first.pitch, 0.1, 1e-9);
}

}  // namespace
}  // namespace sightline::pipeline
