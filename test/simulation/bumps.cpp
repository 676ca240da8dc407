#include "sightline/simulation/bumps.h"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/all_round_view.h"

namespace sightline::simulation {
namespace {

using geometry::Pose2;

TEST(Bumps, TakeTheirShareOfTheWayAndLast) {
  BumpConfig config;
  config.share = 0.21;
  Bumps bumps(config, 3);
  double tilted = 0.0;
  int changes = 0;
  bool was = false;
  constexpr int kSteps = 400000;
  for (int i = 0; i < kSteps; ++i) {
    bumps.advance(0.01);
    const bool is = bumps.pitch() != 0.0;
    tilted += is ? 1.0 : 0.0;
    changes += is != was ? 1 : 0;
    was = is;
  }
  EXPECT_NEAR(tilted / kSteps, 0.21, 0.01);
  EXPECT_NEAR(0.01 * tilted / (0.5 * changes), 0.3, 0.02) << "mean length";
}

TEST(Bumps, KeepARobotThatStandsAsItIs) {
  Bumps bumps({0.5, 0.3, 0.0025, 0.2}, 1);
  const double pitch = bumps.pitch();
  for (int i = 0; i < 1000; ++i) bumps.advance(0.0);
  EXPECT_EQ(bumps.pitch(), pitch);
}

// A robot whose way is all bumps looks past a strip that is 1 in tall and 1 m away (dames
// section 3.4), and sees it closer by.
TEST(Bumps, OfTwoAndAHalfMillimetresLoseAStripAtOneMetre) {
  for (const double distance : {0.8, 1.15}) {
    world::World world;
    world.add(world::WorldDisc{{distance, 0.0}, 0.02, 0.3873, 0.4127, 0});
    RobotConfig robot;
    robot.bumps.share = 0.99;
    robot.bumps.length = 1e3;
    Simulation simulation(world, robot, Pose2(), 1);
    Mounting mounting;
    mounting.z = 0.4;
    simulation.carrier().addScanner(test::allRound(), mounting);
    const scan::Scan scan = test::lastSweeps(simulation, 0.1)[0];
    bool is_seen = false;
    for (std::size_t i = 0; i < scan.beams(); ++i) is_seen |= scan.isValid(i);
    EXPECT_EQ(is_seen, distance < 1.0) << distance;
    EXPECT_NEAR(std::abs(simulation.carrier().bodyMotion(0).attitude.pitch), 0.0125, 1e-6);
  }
}

TEST(Bumps, DoNotTiltARobotOnAnEvenFloor) {
  Simulation simulation(world::World(), {}, Pose2(), 1);
  simulation.carrier().command({0.5, 0.0});
  for (int i = 0; i < 200; ++i) simulation.step();
  EXPECT_EQ(simulation.carrier().bodyMotion(simulation.time()).attitude.pitch, 0.0);
}

}  // namespace
}  // namespace sightline::simulation
