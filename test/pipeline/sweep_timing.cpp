#include "sightline/pipeline/sweep_timing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "dead_reckoning/simulated_scans.h"

namespace sightline::pipeline {
namespace {

using geometry::Pose2;

constexpr std::size_t kBeams = 360;
constexpr double kStep = 2.0 * geometry::kPi / kBeams;

std::shared_ptr<const scan::ScanGeometry> circle(double sweep) {
  return scan::ScanGeometry::uniform(-geometry::kPi, kStep, kBeams, sweep / (kBeams - 1.0), 0.05,
                                     20.0);
}

struct TimedDrive {
  double sweep = 0.1;  // true [s]
  double declared_sweep = 0.1;
  double late = 0.0;  // stamps behind the first beam [s]
  double turn_rate = 0.6;
  double change = 0.8;          // of the turn rate, as an angular frequency [rad/s]
  double turn_scale = 1.0;      // of the odometry
  double odometry_noise = 0.0;  // of the heading's rate [rad/s]
  int scans = 400;
  std::uint64_t seed = 1;
};

struct Found {
  SweepTiming timing;
  std::int64_t shift = 0;
  double sweep = 0.0;       // of the last scan as it was corrected
  int first = -1;           // scan with which something was corrected
  bool is_in_order = true;  // each scan's odometry is from after the one before
};

// A robot that turns on the spot, with rates that change.
Found drive(const TimedDrive& drive) {
  Found found;
  const Pose2 T_base_sensor(0.15, 0.05, 0.2);
  test::Viewer viewer(test::furnishedRoom(), circle(drive.sweep), drive.seed);
  std::mt19937_64 random(drive.seed);
  std::normal_distribution<double> normal;
  const auto rateAt = [&](double time) {
    return drive.turn_rate * (1.0 + std::sin(drive.change * time));
  };
  const auto headingAt = [&](double time) {
    return drive.turn_rate * (time - std::cos(drive.change * time) / drive.change);
  };
  double drift = 0.0;
  std::int64_t before = 0;
  for (int i = 0; i < drive.scans; ++i) {
    const double time = 10.0 + 0.1 * i;
    const auto poseAt = [&](double t) { return Pose2(0.2, -0.3, headingAt(t)); };
    const double middle = time + 0.5 * drive.sweep;
    const Eigen::Vector3d base_twist(0.0, 0.0, rateAt(middle));
    // The sensor's own velocity: the lever arm turns with the base.
    const Eigen::Vector2d arm = T_base_sensor.translation();
    const Eigen::Vector2d along = base_twist[2] * Eigen::Vector2d(-arm.y(), arm.x());
    const Eigen::Vector2d own = Eigen::Rotation2Dd(-T_base_sensor.theta()) * along;
    const scan::Scan seen =
        viewer.look(poseAt(time) * T_base_sensor, time, {own.x(), own.y(), base_twist[2]});
    scan::Scan scan(circle(drive.declared_sweep), seen.stamp + std::llround(1e9 * drive.late),
                    seen.ranges());
    found.shift = found.timing.correct(scan);
    found.sweep = scan.duration();
    if (found.first < 0 && !found.timing.fault().empty()) found.first = i;
    found.is_in_order &= scan.stamp + found.shift > before;
    before = scan.stamp + found.shift;
    drift += 0.1 * drive.odometry_noise * normal(random);
    Pose2 T_odom_base = poseAt(1e-9 * static_cast<double>(scan.stamp + found.shift));
    T_odom_base = Pose2(T_odom_base.translation(), drive.turn_scale * T_odom_base.theta() + drift);
    found.timing.add(scan, found.shift, T_odom_base, T_base_sensor);
  }
  return found;
}

TEST(SweepTiming, LeavesTimesThatAreRightAlone) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    TimedDrive right;
    right.seed = seed;
    right.odometry_noise = 0.02;
    right.turn_scale = seed % 2 == 0 ? 1.05 : 1.0;
    EXPECT_EQ(drive(right).timing.fault(), "");
    right.sweep = right.declared_sweep = 0.0;
    EXPECT_EQ(drive(right).timing.fault(), "");
  }
}

TEST(SweepTiming, FindsStampsOfTheEndOfTheSweepAndLaterOnes) {
  for (const double late : {0.1, 0.05, 0.25, -0.08}) {
    TimedDrive wrong;
    wrong.late = late;
    wrong.odometry_noise = 0.02;
    const Found found = drive(wrong);
    EXPECT_NEAR(1e-9 * static_cast<double>(found.shift), -late, 0.02) << found.timing.fault();
    EXPECT_NEAR(found.sweep, 0.1, 1e-6);
    EXPECT_LT(found.first, 150) << late;
  }
}

TEST(SweepTiming, FindsSweepsInTheOtherOrderTooShortOnesAndOnesThatAreNone) {
  for (const auto& [is, declared] : {std::pair{0.1, -0.1},
                                     {0.18, 0.009},
                                     {0.0, 0.108},
                                     {0.0, -0.108},
                                     {-0.1, 0.1},
                                     {0.15, 0.0}}) {
    TimedDrive wrong;
    wrong.sweep = is;
    wrong.declared_sweep = declared;
    const Found found = drive(wrong);
    EXPECT_NEAR(found.sweep, is, 0.015) << declared << ": " << found.timing.fault();
    EXPECT_NEAR(1e-9 * static_cast<double>(found.shift), 0.0, 0.02) << declared;
  }
}

TEST(SweepTiming, ATurnThatNeverChangesTellsTheSweepAlone) {
  TimedDrive steady;
  steady.change = 1e-3;
  steady.late = 0.1;
  EXPECT_EQ(drive(steady).timing.fault(), "");
  steady.declared_sweep = -0.1;
  EXPECT_NEAR(drive(steady).sweep, 0.1, 0.01);
}

TEST(SweepTiming, OdometryIsShiftedByAndBySoThatItsOrderStays) {
  for (const double late : {0.25, -0.25}) {
    TimedDrive wrong;
    wrong.late = late;
    const Found found = drive(wrong);
    EXPECT_TRUE(found.is_in_order) << late;
    EXPECT_NEAR(1e-9 * static_cast<double>(found.shift), -late, 0.02);
  }
}

TEST(SweepTiming, SigmasAreHonest) {
  double squares = 0.0;
  double sweep_squares = 0.0;
  constexpr int kRuns = 12;
  for (int run = 0; run < kRuns; ++run) {
    TimedDrive noisy;
    noisy.seed = 100 + static_cast<std::uint64_t>(run);
    noisy.odometry_noise = 0.03;
    noisy.scans = 200;
    const Found found = drive(noisy);
    const auto middle = found.timing.middle();
    const auto sweep = found.timing.sweep();
    ASSERT_TRUE(middle && sweep);
    squares += std::pow((middle->value - 0.05) / middle->sigma, 2) / kRuns;
    sweep_squares += std::pow((sweep->value - 0.1) / sweep->sigma, 2) / kRuns;
  }
  EXPECT_LT(squares, 3.0);
  EXPECT_LT(sweep_squares, 3.0);
}

}  // namespace
}  // namespace sightline::pipeline
