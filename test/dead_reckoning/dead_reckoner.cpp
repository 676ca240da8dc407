#include "sightline/dead_reckoning/dead_reckoner.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "config_error.h"
#include "dead_reckoning/simulated_scans.h"
#include "sightline/geometry/angle.h"
#include "sightline/logs/nees.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;
using test::Viewer;

constexpr double kPeriod = 0.2;  // s

void expectNear(const Pose2& estimate, const Pose2& truth, double position, double heading) {
  const Pose2 error = geometry::between(truth, estimate);
  EXPECT_LT(error.translation().norm(), position);
  EXPECT_LT(std::abs(error.theta()), heading);
}

bool isFinite(const DeadReckoningUpdate& update) {
  return update.pose.mean.isFinite() && update.pose.covariance.allFinite() &&
         update.step.mean.isFinite() && update.step.covariance.allFinite() &&
         update.twist.mean.allFinite() && update.twist.covariance.allFinite();
}

// Along an arc through the furnished room.
Pose2 onArc(int scan) {
  return Pose2(-1.5, 0.5, 0.0) * Pose2::exp(scan * Eigen::Vector3d(0.08, 0.0, 0.05));
}

class Methods : public testing::TestWithParam<Method> {};

TEST_P(Methods, FollowAnArc) {
  DeadReckonerConfig config;
  config.method = GetParam();
  DeadReckoner reckoner(config);
  Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  std::optional<DeadReckoningUpdate> update;
  for (int i = 0; i <= 20; ++i) {
    update = reckoner.update(viewer.look(onArc(i), kPeriod * i), Pose2());
    ASSERT_TRUE(update);
    EXPECT_TRUE(isFinite(*update));
    EXPECT_FALSE(update->isFlagged()) << i;
  }
  const double rough = GetParam() == Method::kSubmap ? 1.0 : 6.0;
  expectNear(update->pose.mean, geometry::between(onArc(0), onArc(20)), 0.01 * rough,
             0.005 * rough);
}

INSTANTIATE_TEST_SUITE_P(DeadReckoner, Methods,
                         testing::Values(Method::kSubmap, Method::kPoseSpace, Method::kHistogram));

TEST(DeadReckoner, RecoversAnyMotionWithinTheCarriersReach) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  DeadReckonerConfig config;
  config.carrier.max_speed = 2.0;
  config.carrier.max_turn_rate = geometry::radians(200.0);
  config.carrier.acceleration = 4.0;
  config.carrier.turn_acceleration = 15.0;
  for (std::uint64_t run = 0; run < 60; ++run) {
    Viewer viewer(test::furnishedRoom(), test::scanner(), run);
    const Pose2 first(unit(random), 0.5 * unit(random), geometry::kPi * unit(random));
    const Pose2 motion(0.28 * unit(random), 0.28 * unit(random),
                       geometry::radians(38.0) * unit(random));
    DeadReckoner reckoner(config);
    reckoner.update(viewer.look(first, 0.0), Pose2());
    const auto update = reckoner.update(viewer.look(first * motion, kPeriod), Pose2());
    ASSERT_TRUE(update);
    EXPECT_EQ(update->state, MatchState::kMatched) << run;
    expectNear(update->step.mean, motion, 0.02, 0.01);
  }
}

TEST(DeadReckoner, StepsAreAsUncertainAsTheyErr) {
  double sum = 0.0;
  int steps = 0;
  for (std::uint64_t run = 0; run < 20; ++run) {
    DeadReckoner reckoner({});
    Viewer viewer(test::furnishedRoom(), test::scanner(), 100 + run);
    reckoner.update(viewer.look(onArc(0), 0.0), Pose2());
    for (int i = 1; i <= 15; ++i) {
      const auto update = reckoner.update(viewer.look(onArc(i), kPeriod * i), Pose2());
      sum += logs::nees(update->step, geometry::between(onArc(i - 1), onArc(i)));
      ++steps;
    }
  }
  EXPECT_GT(sum / steps, 2.0);
  EXPECT_LT(sum / steps, 4.0);
}

TEST(DeadReckoner, TheWayAlongAPlainCorridorIsUncertain) {
  DeadReckoner reckoner({});
  Viewer viewer(test::plainCorridor(), test::scanner(361, geometry::kPi, 8.0), 3);
  std::vector<DeadReckoningUpdate> updates;
  for (int i = 0; i <= 40; ++i) {
    updates.push_back(*reckoner.update(viewer.look({0.1 * i, 0.0, 0.0}, kPeriod * i), Pose2()));
  }
  const Eigen::Matrix3d& early = updates[10].pose.covariance;
  const Eigen::Matrix3d& late = updates[40].pose.covariance;
  EXPECT_GT(std::sqrt(late(0, 0)), 10.0 * std::sqrt(late(1, 1)));
  EXPECT_GT(late(0, 0), 2.0 * early(0, 0));
  EXPECT_LT(std::sqrt(late(1, 1)), 0.03);
  EXPECT_NEAR(updates[40].pose.mean.y(), 0.0, 0.02);
  EXPECT_NEAR(updates[40].pose.mean.theta(), 0.0, 0.02);
  // Nothing tells standing from going on.
  EXPECT_LT(std::abs(updates[40].pose.mean.x() - 4.0), 4.0 * std::sqrt(late(0, 0)));
}

TEST(DeadReckoner, APriorTellsTheWayAlongAPlainCorridor) {
  DeadReckoner reckoner({});
  Viewer viewer(test::plainCorridor(), test::scanner(361, geometry::kPi, 8.0), 3);
  MotionPrior prior{{0.1, 0.0, 0.0}, Eigen::Vector3d(1e-6, 1e-4, 1e-4).asDiagonal()};
  std::optional<DeadReckoningUpdate> update;
  for (int i = 0; i <= 40; ++i) {
    update = reckoner.update(viewer.look({0.1 * i, 0.0, 0.0}, kPeriod * i), Pose2(), prior);
  }
  expectNear(update->pose.mean, {4.0, 0.0, 0.0}, 0.1, 0.01);
  EXPECT_LT(std::sqrt(update->pose.covariance(0, 0)), 0.05);
}

TEST(DeadReckoner, ASquareRoomIsAmbiguousAfterAnyTurn) {
  DeadReckonerConfig config;
  config.carrier.max_turn_rate = 10.0;
  config.carrier.turn_acceleration = 50.0;
  DeadReckoner reckoner(config);
  const auto full_circle =
      scan::ScanGeometry::uniform(-geometry::kPi, geometry::kPi / 180.0, 360, 0.0, 0.05, 20.0);
  Viewer viewer(test::squareRoom(), full_circle, 5);
  reckoner.update(viewer.look({0.1, 0.0, 0.0}, 0.0), Pose2());
  const auto update = reckoner.update(viewer.look({0.1, 0.0, 0.4}, 0.3), Pose2());
  EXPECT_EQ(update->state, MatchState::kAmbiguous);
  EXPECT_TRUE(update->isFlagged());
  EXPECT_GT(std::sqrt(update->step.covariance(2, 2)), 1.0);
}

TEST(DeadReckoner, ScansWithoutReturnsAreBridgedByThePrior) {
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  reckoner.update(viewer.look(onArc(0), 0.0), Pose2());
  const MotionPrior prior{geometry::between(onArc(0), onArc(1)),
                          Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal()};
  for (int i = 1; i <= 3; ++i) {
    scan::Scan blind = viewer.look(onArc(i), kPeriod * i);
    for (std::size_t k = 0; k < blind.beams(); ++k) {
      blind.setRange(k, std::numeric_limits<double>::quiet_NaN());
    }
    const auto update = reckoner.update(blind, Pose2(), prior);
    EXPECT_EQ(update->state, MatchState::kFailed);
    EXPECT_TRUE(isFinite(*update));
    expectNear(update->step.mean, prior.T_before_now, 1e-9, 1e-9);
  }
  const auto update = reckoner.update(viewer.look(onArc(4), kPeriod * 4), Pose2(), prior);
  EXPECT_EQ(update->state, MatchState::kMatched);
  expectNear(update->pose.mean, geometry::between(onArc(0), onArc(4)), 0.02, 0.01);
}

TEST(DeadReckoner, BeamsThatAreNotNumbersAreLeftOut) {
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  std::optional<DeadReckoningUpdate> update;
  for (int i = 0; i <= 10; ++i) {
    scan::Scan scan = viewer.look(onArc(i), kPeriod * i);
    for (std::size_t k = 0; k < scan.beams(); k += 3) {
      scan.setRange(k, k % 2 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                  : std::numeric_limits<double>::infinity());
      // Even where somebody calls them valid.
      if (k % 5 == 0) scan.setKind(k, scan::ReturnKind::kValid);
    }
    update = reckoner.update(scan, Pose2());
  }
  EXPECT_FALSE(update->isFlagged());
  expectNear(update->pose.mean, geometry::between(onArc(0), onArc(10)), 0.02, 0.01);
}

TEST(DeadReckoner, ShortScansAreNoMatch) {
  DeadReckoner reckoner({});
  const auto few = scan::ScanGeometry::uniform(-0.05, 0.02, 6, 0.0, 0.05, 20.0);
  Viewer viewer(test::furnishedRoom(), few, 1);
  for (int i = 0; i < 4; ++i) {
    const auto update = reckoner.update(viewer.look(onArc(i), kPeriod * i), Pose2());
    ASSERT_TRUE(update);
    EXPECT_TRUE(isFinite(*update));
    EXPECT_EQ(update->state, i == 0 ? MatchState::kInitial : MatchState::kFailed);
  }
}

TEST(DeadReckoner, AScanThatIsNotNewerIsLeftOut) {
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  EXPECT_TRUE(reckoner.update(viewer.look(onArc(0), 1.0), Pose2()));
  EXPECT_FALSE(reckoner.update(viewer.look(onArc(0), 1.0), Pose2()));
  EXPECT_FALSE(reckoner.update(viewer.look(onArc(0), 0.5), Pose2()));
  reckoner.restartClock();
  const auto update = reckoner.update(viewer.look(onArc(0), 0.5), Pose2());
  ASSERT_TRUE(update);
  EXPECT_EQ(update->state, MatchState::kInitial);
}

TEST(DeadReckoner, AChangeOfTheScanRateIsNoHarm) {
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  std::optional<DeadReckoningUpdate> update;
  for (const int i : {0, 1, 2, 3, 5, 8, 12, 13, 14, 18}) {
    update = reckoner.update(viewer.look(onArc(i), kPeriod * i), Pose2());
    EXPECT_FALSE(update->isFlagged()) << i;
  }
  expectNear(update->pose.mean, geometry::between(onArc(0), onArc(18)), 0.02, 0.01);
}

TEST(DeadReckoner, ResetGoesToTheGivenPose) {
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  for (int i = 0; i < 5; ++i) reckoner.update(viewer.look(onArc(i), kPeriod * i), Pose2());
  reckoner.reset({5.0, 6.0, 1.0});
  const auto update = reckoner.update(viewer.look(onArc(9), 0.1), Pose2());
  EXPECT_EQ(update->state, MatchState::kInitial);
  expectNear(update->pose.mean, {5.0, 6.0, 1.0}, 1e-12, 1e-12);
  EXPECT_TRUE(update->pose.covariance.isZero());
}

// Upside down, the beams of a sensor come from left to right.
TEST(DeadReckoner, BeamsMayComeClockwiseFromASensorAnywhere) {
  const auto clockwise = scan::ScanGeometry::uniform(0.5 * geometry::kPi, -geometry::kPi / 360.0,
                                                     361, 0.0, 0.05, 20.0);
  const Pose2 T_base_sensor(0.3, -0.1, 0.6);
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), clockwise, 1);
  std::optional<DeadReckoningUpdate> update;
  for (int i = 0; i <= 20; ++i) {
    update = reckoner.update(viewer.look(onArc(i) * T_base_sensor, kPeriod * i), T_base_sensor);
  }
  EXPECT_FALSE(update->isFlagged());
  expectNear(update->pose.mean, geometry::between(onArc(0), onArc(20)), 0.01, 0.005);
}

TEST(DeadReckoner, ASweepIsCorrectedByTheMotionFound) {
  const auto slow = scan::ScanGeometry::uniform(-0.5 * geometry::kPi, geometry::kPi / 360.0, 361,
                                                0.1 / 361.0, 0.05, 20.0);
  const Eigen::Vector3d twist(0.4, 0.0, 0.25);  // onArc, in seconds
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), slow, 1);
  std::optional<DeadReckoningUpdate> update;
  // The first scan is taken for one at rest: nothing is known of its motion.
  constexpr int kSettled = 5;
  Pose2 settled;
  for (int i = 0; i <= 20; ++i) {
    update = reckoner.update(viewer.look(onArc(i), kPeriod * i, twist), Pose2());
    if (i == kSettled) settled = update->pose.mean;
  }
  EXPECT_FALSE(update->isFlagged());
  expectNear(geometry::between(settled, update->pose.mean),
             geometry::between(onArc(kSettled), onArc(20)), 0.02, 0.01);
  EXPECT_LT((update->twist.mean - twist).cwiseAbs().maxCoeff(), 0.03);
}

TEST(DeadReckoner, AWrongPriorIsFoundOut) {
  DeadReckoner reckoner({});
  Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  reckoner.update(viewer.look(onArc(0), 0.0), Pose2());
  // The wheels have slipped.
  const MotionPrior prior{geometry::between(onArc(0), onArc(1)) * Pose2(0.0, 0.0, 0.25),
                          Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal()};
  const auto update = reckoner.update(viewer.look(onArc(1), kPeriod), Pose2(), prior);
  EXPECT_EQ(update->state, MatchState::kMatched);
  expectNear(update->step.mean, geometry::between(onArc(0), onArc(1)), 0.02, 0.01);
}

TEST(DeadReckonerConfig, OutOfRangeIsNamed) {
  DeadReckonerConfig config;
  config.carrier.max_speed = -1.0;
  EXPECT_THROW(DeadReckoner{config}, config::Error);
}

}  // namespace
}  // namespace sightline::dead_reckoning
