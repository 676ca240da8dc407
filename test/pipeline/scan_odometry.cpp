#include "sightline/pipeline/scan_odometry.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "config_error.h"
#include "scan_edits.h"
#include "sightline/motion/floor.h"
#include "sightline/motion/pose_history.h"
#include "sightline/simulation/simulation.h"

namespace sightline::pipeline {
namespace {

using dead_reckoning::DeadReckoningUpdate;
using geometry::Pose2;
using geometry::radians;

world::World room() {
  world::World world;
  world.add(world::WorldPlate{{}, 0.0, 0});
  world.add(world::WorldPlate{{}, 2.6, 0});
  const std::vector<Eigen::Vector2d> corners{{-4.0, -3.0}, {5.0, -3.0}, {5.0, 1.0},
                                             {3.5, 1.0},   {3.5, 3.0},  {-4.0, 3.0}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    world::WorldSegment segment;
    segment.segment = {corners[i], corners[(i + 1) % corners.size()]};
    world.add(segment);
  }
  return world;
}

// A robot or a person on a curve through a room, 361 beams over 180 degrees at 10 Hz.
class Walk {
 public:
  explicit Walk(bool nods = false) : simulation_(room(), {}, Pose2(-2.0, -1.0, 0.2), 3) {
    if (nods) simulation_.carrier().walk({});
    simulation::ScannerProfile profile;
    profile.beams = 361;
    profile.angle_min = radians(-90.0);
    profile.angle_max = radians(90.0);
    profile.rate = 10.0;
    simulation::Mounting mounting;
    mounting.z = 1.2;
    simulation_.carrier().addScanner(profile, mounting);
  }

  const simulation::Simulation& simulation() const { return simulation_; }

  template <class Take>
  void run(double seconds, const Take& take) {
    while (1e-9 * static_cast<double>(simulation_.time()) < seconds) {
      simulation_.carrier().command({0.5, 0.25});
      auto sweeps = simulation_.step().sweeps;
      wheels_.add(simulation_.time(), simulation_.robot().odometry().pose().mean);
      for (auto& sweep : sweeps) take(sweep.scan);
    }
  }

  std::optional<Pose2> wheelsAt(std::int64_t stamp) const { return wheels_.at(stamp); }
  Pose2 truthAt(std::int64_t stamp) const { return simulation_.carrier().T_map_base(stamp); }

  motion::SweepAttitude attitudeOf(const scan::Scan& scan) const {
    const auto end = scan.stamp + std::llround(1e9 * scan.geometry()->timeOffsets().back());
    return {simulation_.carrier().bodyMotion(scan.stamp).attitude,
            simulation_.carrier().bodyMotion(end).attitude};
  }

 private:
  simulation::Simulation simulation_;
  motion::PoseHistory wheels_;
};

LocatedScan located(const scan::Scan& scan) {
  LocatedScan result;
  result.scan = scan;
  result.T_base_sensor = Pose2();
  return result;
}

Pose2 errorOf(const DeadReckoningUpdate& update, const Pose2& truth_first, const Pose2& truth) {
  return geometry::between(geometry::between(truth_first, truth), update.pose.mean);
}

// A scanner whose attitude is known, as the estimators hand it on: level, and without floor.
LocatedScan levelledScan(const scan::Scan& scan, const motion::SweepAttitude& attitude) {
  const auto on_floor = motion::beamsOnFloor({}, scan, attitude);
  LocatedScan result = located(motion::without(motion::levelled(scan, attitude), on_floor));
  result.attitude = attitude;
  return result;
}

void expectToFollow(const ScanOdometryConfig& config, bool nods, bool knows_attitude) {
  Walk walk(nods);
  ScanOdometry odometry(config, nods ? std::make_optional(motion::FloorConfig()) : std::nullopt);
  std::optional<Pose2> first;
  walk.run(10.0, [&](const scan::Scan& scan) {
    const Pose2 truth = walk.truthAt(scan.stamp);
    if (!first) first = truth;
    const auto update =
        odometry.update(knows_attitude ? levelledScan(scan, walk.attitudeOf(scan)) : located(scan));
    ASSERT_TRUE(update);
    const Pose2 error = errorOf(*update, *first, truth);
    EXPECT_LT(error.translation().norm(), 0.06);
    EXPECT_LT(std::abs(error.theta()), 0.02);
  });
}

TEST(ScanOdometry, FollowsARobotByItsScansAlone) {
  expectToFollow({}, /*nods=*/false, /*knows_attitude=*/false);
}

TEST(ScanOdometry, FollowsAPersonWhoNods) {
  ScanOdometryConfig config;
  config.matching.carrier.turn_acceleration = 4.0;
  expectToFollow(config, /*nods=*/true, /*knows_attitude=*/false);
  expectToFollow(config, /*nods=*/true, /*knows_attitude=*/true);
}

TEST(ScanOdometry, BeginsWhereTheWheelsAre) {
  Walk walk;
  ScanOdometry odometry({});
  const Pose2 elsewhere(3.0, -2.0, 2.0);
  std::optional<Pose2> first;
  Pose2 last;
  walk.run(5.0, [&](const scan::Scan& scan) {
    LocatedScan aided = located(scan);
    aided.T_odom_base = elsewhere * *walk.wheelsAt(std::max<std::int64_t>(
                                        scan.stamp, simulation::Simulation::kStep));
    const auto update = odometry.update(aided);
    ASSERT_TRUE(update);
    if (!first) {
      EXPECT_EQ(update->pose.mean.coordinates(), aided.T_odom_base->coordinates());
      first = walk.truthAt(scan.stamp);
    }
    last = geometry::between(geometry::between(*first, walk.truthAt(scan.stamp)),
                             geometry::between(elsewhere, update->pose.mean));
  });
  EXPECT_LT(last.translation().norm(), 0.05);
}

TEST(ScanOdometry, AGyroscopeBringsItThroughScansThatSayNothing) {
  Walk walk;
  ScanOdometry odometry({});
  std::optional<std::int64_t> before;
  double turned = 0.0;
  std::optional<Pose2> first;
  walk.run(6.0, [&](scan::Scan scan) {
    const Pose2 truth = walk.truthAt(scan.stamp);
    if (!first) first = truth;
    const double time = 1e-9 * static_cast<double>(scan.stamp);
    if (time > 3.0 && time < 3.5) {
      test::setKinds(scan, scan::ReturnKind::kInvalid);
    }
    LocatedScan aided = located(scan);
    if (before) {
      aided.turn = geometry::between(walk.truthAt(*before), truth).theta();
      turned += *aided.turn;
    }
    before = scan.stamp;
    const auto update = odometry.update(aided);
    ASSERT_TRUE(update);
    EXPECT_LT(std::abs(geometry::wrapAngle(errorOf(*update, *first, truth).theta())), 0.02);
  });
  EXPECT_GT(turned, 1.0);
}

TEST(ScanOdometry, GoesOnAfterAGapOfAnyLength) {
  for (const std::int64_t gap : {10'000'000'000, 100'000'000'000'000}) {
    Walk walk;
    ScanOdometry odometry({});
    int scans = 0;
    std::optional<Pose2> first;
    Pose2 truth_first;
    walk.run(4.0, [&](scan::Scan scan) {
      const Pose2 truth = walk.truthAt(scan.stamp);
      if (++scans >= 20) scan.stamp += gap;
      const auto update = odometry.update(located(scan));
      ASSERT_TRUE(update);
      if (scans < 20) return;
      if (!first) {
        // The scans tell where it is: nobody moved it far.
        EXPECT_FALSE(update->isFlagged());
        first = update->pose.mean;
        truth_first = truth;
      }
      const Pose2 error = geometry::between(geometry::between(truth_first, truth),
                                            geometry::between(*first, update->pose.mean));
      EXPECT_LT(error.translation().norm(), 0.05);
    });
  }
}

TEST(ScanOdometry, AnHourOfScansThatSayNothingIsOutlived) {
  Walk walk;
  ScanOdometry odometry({});
  int scans = 0;
  std::int64_t delay = 0;
  walk.run(3.0, [&](scan::Scan scan) {
    if (++scans == 20) {
      scan::Scan blind = scan;
      test::setKinds(blind, scan::ReturnKind::kInvalid);
      for (; delay < 3'600'000'000'000; delay += 2'500'000'000) {
        blind.stamp = scan.stamp + delay;
        const auto update = odometry.update(located(blind));
        ASSERT_TRUE(update);
        EXPECT_TRUE(update->isFlagged() && update->pose.mean.isFinite());
      }
    }
    scan.stamp += delay;
    const auto update = odometry.update(located(scan));
    ASSERT_TRUE(update);
    if (scans <= 25) return;
    EXPECT_GT(update->inliers, 0.5) << "it matches again";
  });
}

TEST(ScanOdometry, ForgetsWhereItWas) {
  Walk walk;
  ScanOdometry odometry({});
  int scans = 0;
  walk.run(3.0, [&](const scan::Scan& scan) {
    if (++scans == 20) odometry.reset();
    const auto update = odometry.update(located(scan));
    ASSERT_TRUE(update);
    if (scans == 20) {
      EXPECT_EQ(update->state, dead_reckoning::MatchState::kInitial);
      EXPECT_EQ(update->pose.mean.coordinates(), Eigen::Vector3d::Zero());
    }
    EXPECT_FALSE(odometry.update(located(scan))) << "the same scan once more";
  });
}

TEST(ScanOdometry, ClockSetBackKeepsThePose) {
  Walk walk;
  ScanOdometry odometry({});
  int scans = 0;
  Pose2 before;
  walk.run(3.0, [&](scan::Scan scan) {
    if (++scans == 20) odometry.restartClock();
    if (scans >= 20) scan.stamp -= 2'500'000'000;
    const auto update = odometry.update(located(scan));
    ASSERT_TRUE(update);
    EXPECT_LT((update->pose.mean.translation() - before.translation()).norm(), 0.2);
    before = update->pose.mean;
  });
}

TEST(WheelPrior, IsWiderTheLongerTheStepAndPositiveDefinite) {
  const WheelsConfig config;
  const auto none = wheelPrior(config, Pose2());
  const auto some = wheelPrior(config, Pose2(0.5, 0.0, 0.1));
  const auto more = wheelPrior(config, Pose2(1.0, 0.0, 0.2));
  EXPECT_NEAR(none.covariance(0, 0), 4e-4, 1e-9);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(none.covariance(i, i), some.covariance(i, i));
    EXPECT_LT(some.covariance(i, i), more.covariance(i, i));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(more.covariance);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
  EXPECT_NEAR(more.T_before_now.x(), 1.0, 1e-9);
}

TEST(ScanOdometry, NamesASettingOutOfRange) {
  ScanOdometryConfig config;
  config.wheels.position_sigma = 0.0;
  EXPECT_EQ(test::errorOf([&] { ScanOdometry{config}; }).key(), "wheels.position_sigma");
}

}  // namespace
}  // namespace sightline::pipeline
