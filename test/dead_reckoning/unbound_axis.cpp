#include "sightline/dead_reckoning/unbound_axis.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "dead_reckoning/simulated_scans.h"
#include "sightline/dead_reckoning/dead_reckoner.h"

namespace sightline::dead_reckoning {
namespace {

Eigen::Matrix3d turnedBy(double angle, const Eigen::Vector3d& diagonal) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return axes * diagonal.asDiagonal() * axes.transpose();
}

// Along a corridor at `angle`: known to millimetres across, to two metres along.
Eigen::Matrix3d looseAlong(double angle) {
  return turnedBy(angle, {4.0, 1e-6, 1e-6});
}
Eigen::Matrix3d knownAcross(double angle, double along = 0.0) {
  return turnedBy(angle, {along, 1e6, 1e6});
}

TEST(UnboundAxis, ThePriorIsTurnedToTheAxisThatTheMatchLeavesOpen) {
  for (const double off : {-0.02, 0.005}) {
    const Eigen::Matrix3d turned = turnedToUnbound(looseAlong(0.5), knownAcross(0.5 + off));
    EXPECT_TRUE(turned.isApprox(looseAlong(0.5 + off), 1e-9));
  }
}

TEST(UnboundAxis, AMatchThatBindsItOrAnotherDirectionLeavesItAsItIs) {
  const Eigen::Matrix3d prior = looseAlong(0.5);
  EXPECT_EQ(turnedToUnbound(prior, knownAcross(0.505, 100.0)), prior);
  EXPECT_EQ(turnedToUnbound(prior, knownAcross(0.7)), prior);
  EXPECT_EQ(turnedToUnbound(1e-4 * prior, knownAcross(0.505)), 1e-4 * prior);
  EXPECT_TRUE(turnedToUnbound(prior, Eigen::Matrix3d::Zero()).allFinite());
}

// What is predicted and not measured is no sign that the robot goes on evenly, and no match.
TEST(UnboundAxis, AlongAPlainCorridorItIsNotSureOfItsStepsAndSaysSo) {
  DeadReckoner reckoner({});
  test::Viewer viewer(test::plainCorridor(), test::scanner(361, geometry::kPi, 8.0), 3);
  const double expected = reckoner.expectedMotion().acceleration;
  std::optional<DeadReckoningUpdate> update;
  for (int i = 0; i <= 40; ++i) {
    update = reckoner.update(viewer.look({0.1 * i, 0.0, 0.0}, 0.2 * i), geometry::Pose2());
  }
  EXPECT_GT(reckoner.expectedMotion().acceleration, 0.8 * expected);
  EXPECT_EQ(update->state, MatchState::kUnbound);
  EXPECT_TRUE(update->isFlagged());
  EXPECT_GT(std::sqrt(update->step.covariance(0, 0)), 0.1);
  EXPECT_LT(std::sqrt(update->step.covariance(0, 0)), 0.3);
}

}  // namespace
}  // namespace sightline::dead_reckoning
