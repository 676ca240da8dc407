#include "sightline/tracking/validation_gate.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sightline::tracking {
namespace {

using geometry::Pose2;

// The north side of a room: along −x at y = 2, the room below it.
world::Wall northWall() {
  world::Wall wall;
  wall.name = "north";
  wall.segment = {{4.0, 2.0}, {-4.0, 2.0}};
  wall.spans = {{0.0, 3.0}, {5.0, 8.0}};
  return wall;
}

BeamPoint beamTo(double x, double y) {
  BeamPoint point;
  point.position = {x, y};
  point.origin = {0.0, 0.0};
  point.covariance = Eigen::Matrix2d::Identity() * 1e-4;
  return point;
}

geometry::UncertainPose2 poseOf(double position_sigma, double heading_sigma) {
  geometry::UncertainPose2 pose;
  pose.covariance.diagonal() << position_sigma * position_sigma, position_sigma * position_sigma,
      heading_sigma * heading_sigma;
  return pose;
}

TEST(ValidationGate, OpensByPoseMapAndSensor) {
  const world::Wall wall = northWall();
  const ValidationGate gate({}, wall, 0.03, poseOf(0.04, 0.01), 0.12);
  EXPECT_NEAR(gate.size().opening, 3.0 * std::hypot(0.04, 0.03, 0.12), 1e-12);
  EXPECT_NEAR(gate.size().angle, std::atan(3.0 * 0.01), 1e-12);
}

TEST(ValidationGate, IsBoundedHoweverVagueThePose) {
  const world::Wall wall = northWall();
  const GateConfig config;
  const ValidationGate gate(config, wall, 0.0, poseOf(50.0, 3.0), 0.01);
  EXPECT_DOUBLE_EQ(gate.size().opening, config.max_opening);
  EXPECT_DOUBLE_EQ(gate.size().angle, config.max_angle);
}

TEST(ValidationGate, WidensAlongTheWall) {
  const world::Wall wall = northWall();
  const ValidationGate gate({}, wall, 0.0, poseOf(0.02, 0.02), 0.01);
  const double foot = gate.size().opening;
  const double far = foot + 3.0 * std::tan(gate.size().angle);
  EXPECT_TRUE(gate.contains(beamTo(3.0, 2.0 + 0.99 * far)) &&
              gate.contains(beamTo(3.0, 2.0 - 0.99 * far)));
  EXPECT_FALSE(gate.contains(beamTo(3.0, 2.0 + 1.01 * far)));
  EXPECT_FALSE(gate.contains(beamTo(1.2, 2.0 + 0.99 * far)));
}

TEST(ValidationGate, HoldsOnlyWhereTheWallReallyIs) {
  const world::Wall wall = northWall();
  const ValidationGate gate({}, wall, 0.0, poseOf(0.001, 0.001), 0.01);
  EXPECT_TRUE(gate.contains(beamTo(2.0, 2.0)));
  EXPECT_FALSE(gate.contains(beamTo(0.0, 2.0))) << "in the opening between the spans";
  EXPECT_FALSE(gate.contains(beamTo(4.5, 2.0))) << "past the end";
}

TEST(ValidationGate, IsForBeamsFromInside) {
  const world::Wall wall = northWall();
  const ValidationGate gate({}, wall, 0.0, poseOf(0.001, 0.001), 0.01);
  BeamPoint from_behind = beamTo(2.0, 2.0);
  from_behind.origin = {2.0, 5.0};
  EXPECT_FALSE(gate.contains(from_behind));
}

TEST(ValidationGate, FollowsThePose) {
  const world::Wall wall = northWall();
  geometry::UncertainPose2 pose = poseOf(0.001, 0.001);
  pose.mean = Pose2(2.0, 1.0, geometry::kPi / 2.0);  // looks at the wall from one metre
  const ValidationGate gate({}, wall, 0.0, pose, 0.01);
  EXPECT_NEAR(gate.predicted().rho, 1.0, 1e-12);
  EXPECT_NEAR(gate.predicted().phi, 0.0, 1e-12);
  EXPECT_TRUE(gate.contains(beamTo(1.0, 0.0)));
}

}  // namespace
}  // namespace sightline::tracking
