// Several robots in one simulation, and what is said of each.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/all_round_view.h"

namespace sightline::simulation {
namespace {

using geometry::Pose2;
using test::allRound;
using test::lastSweeps;
using test::nearestOf;
using test::straight;

TEST(Robots, SeeEachOtherButNotThemselves) {
  Simulation simulation(world::World(), 1);
  RobotConfig config;
  config.body.radius = 0.2;
  simulation.addRobot(config, Pose2(0.0, 0.0, 0.0));
  config.body.radius = 0.3;
  simulation.addRobot(config, Pose2(0.0, 4.0, 0.0));
  Mounting mounting;
  mounting.z = 0.4;
  for (std::size_t i = 0; i < 2; ++i) simulation.carrier(i).addScanner(allRound(), mounting);
  const auto scans = lastSweeps(simulation, 0.1);
  EXPECT_NEAR(nearestOf(scans[0]).first, 3.7, 1e-5);
  EXPECT_NEAR(nearestOf(scans[0]).second, geometry::radians(90.0), 1e-5);
  EXPECT_NEAR(nearestOf(scans[1]).first, 3.8, 1e-5);
  EXPECT_NEAR(nearestOf(scans[1]).second, -geometry::radians(90.0), 1e-5);
}

TEST(Robots, AreSeenWhereTheyAreAtTheTimeOfEachBeam) {
  Simulation simulation(world::World(), 1);
  RobotConfig config;
  config.acceleration = 1e6;
  simulation.addRobot(config, Pose2());
  simulation.addRobot(config, Pose2(2.0, 0.0, 0.0));
  ScannerProfile profile = allRound();
  profile.angle_min = -0.02;
  profile.angle_max = 0.02;
  profile.beams = 41;
  profile.rate = 2.0;
  profile.revolution = 25.0;  // slow: 41 beams take 0.16 s
  Mounting mounting;
  mounting.z = 0.4;
  simulation.carrier(0).addScanner(profile, mounting);
  while (true) {
    simulation.carrier(1).command({0.8, 0.0});
    const auto sweeps = simulation.step().sweeps;
    if (sweeps.empty() || sweeps[0].scan.stamp == 0) continue;
    const scan::Scan& scan = sweeps[0].scan;
    const auto& offsets = scan.geometry()->timeOffsets();
    const auto at = [&](std::size_t beam) {
      const auto time = scan.stamp + std::llround(1e9 * offsets[beam]);
      const double x = simulation.carrier(1).T_map_base(time).x();
      const double angle = scan.geometry()->angles()[beam];
      // On a circle of 0.25 m about (x, 0).
      return x * std::cos(angle) - std::sqrt(0.25 * 0.25 - std::pow(x * std::sin(angle), 2));
    };
    for (std::size_t i = 0; i < scan.beams(); ++i) EXPECT_NEAR(scan.ranges()[i], at(i), 1e-5);
    EXPECT_GT(scan.ranges()[40] - scan.ranges()[0], 0.1) << "it drives away within the sweep";
    return;
  }
}

// All that a robot measures, in numbers.
std::vector<double> runOf(Simulation& simulation, std::size_t robot, double seconds) {
  std::vector<double> all;
  while (simulation.time() < std::llround(1e9 * seconds)) {
    for (std::size_t i = 0; i < simulation.robots(); ++i) {
      simulation.carrier(i).command({0.4, 0.3});
    }
    const Outputs outputs = simulation.step();
    for (const FinishedSweep& sweep : outputs.sweeps) {
      if (sweep.robot != robot) continue;
      all.insert(all.end(), sweep.scan.ranges().begin(), sweep.scan.ranges().end());
    }
    for (const FinishedRangeScan& finished : outputs.range_scans) {
      const scan::Scan& scan = finished.range_scan.scan;
      if (finished.robot != robot) continue;
      for (std::size_t i = 0; i < scan.beams(); ++i) {
        if (scan.isValid(i)) all.push_back(scan.ranges()[i]);
      }
    }
    for (const ReportedState& state : outputs.states) {
      const auto pose = state.pose.mean.coordinates();
      if (state.robot == robot) all.insert(all.end(), pose.begin(), pose.end());
    }
  }
  return all;
}

std::vector<double> runWith(std::size_t robots, bool mover, std::uint64_t seed,
                            std::size_t observed = 0) {
  Simulation simulation(
      world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/living_room.yaml"), seed);
  RobotConfig config;
  config.body.radius = 0.0;  // unseen, so that the runs can be compared
  Mounting mounting;
  mounting.z = 0.4;
  for (std::size_t i = 0; i < robots; ++i) {
    Carrier& carrier = simulation.addRobot(config, Pose2(-0.8, 1.0, 0.3));
    carrier.addScanner({}, mounting);
    carrier.addActiveSensor({}, mounting);
  }
  Body body;
  body.radius = 0.0;
  if (mover) simulation.addMover(body, straight({1.0, 0.0}, 1.0), Pose2());
  return runOf(simulation, observed, 0.5);
}

TEST(Robots, WhatIsRandomDoesNotDependOnHowManyThereAre) {
  const auto alone = runWith(1, false, 1);
  EXPECT_EQ(alone, runWith(1, false, 1)) << "same seed, same run";
  EXPECT_EQ(alone, runWith(3, true, 1));
  EXPECT_NE(alone, runWith(1, false, 2));
  EXPECT_NE(alone, runWith(2, false, 1, 1)) << "each robot has noise of its own";
}

TEST(Robots, ThePairOfAConstructorIsTheFirstOfMany) {
  Mounting mounting;
  mounting.z = 0.4;
  const auto world = world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/living_room.yaml");
  Simulation one(world, {}, Pose2(-0.8, 1.0, 0.3), 1);
  one.carrier().addScanner({}, mounting);
  Simulation other(world, 1);
  other.addRobot({}, Pose2(-0.8, 1.0, 0.3)).addScanner({}, mounting);
  EXPECT_EQ(runOf(one, 0, 0.3), runOf(other, 0, 0.3));
}

TEST(Outputs, OdometryReportsAtItsRateFromTheStartOn) {
  Simulation simulation(world::World(), {}, Pose2(), 1);
  simulation.carrier().setOdometryRate(20.0);
  std::vector<ReportedState> states;
  while (simulation.time() < 1'000'000'000) {
    simulation.carrier().command({0.5, 0.2});
    for (const ReportedState& state : simulation.step().states) states.push_back(state);
  }
  ASSERT_EQ(states.size(), 21u);
  EXPECT_EQ(states[0].twist.mean, Eigen::Vector3d::Zero());
  for (std::size_t i = 1; i < states.size(); ++i) {
    EXPECT_EQ(states[i].stamp, static_cast<std::int64_t>(i) * 50'000'000);
    const Pose2 step = geometry::between(states[i - 1].pose.mean, states[i].pose.mean);
    EXPECT_TRUE(states[i].twist.mean.isApprox(step.log() / 0.05, 1e-12));
    EXPECT_GT(states[i].twist.covariance(0, 0), 0.0);
  }
  EXPECT_EQ(states.back().T_map_base.coordinates(),
            simulation.carrier().T_map_base(1'000'000'000).coordinates());
}

// A perfect inertial sensor: its turn rate, summed, is the heading.
TEST(Outputs, InertialMotionIsThatOfTheBase) {
  Simulation simulation(world::World(), {}, Pose2(), 1);
  simulation.carrier().walk({});
  double heading = simulation.carrier().T_map_base(0).theta();
  double largest_pitch = 0.0;
  while (simulation.time() < 3'000'000'000) {
    simulation.carrier().command({1.0, 0.3});
    const auto motions = simulation.step().motions;
    ASSERT_EQ(motions.size(), 1u);
    heading += 0.005 * motions[0].turn_rate;
    EXPECT_EQ(motions[0].stamp, simulation.time());
    EXPECT_EQ(motions[0].attitude.pitch,
              simulation.carrier().bodyMotion(simulation.time()).attitude.pitch);
    largest_pitch = std::max(largest_pitch, std::abs(motions[0].attitude.pitch));
  }
  EXPECT_NEAR(heading, simulation.carrier().T_map_base(simulation.time()).theta(), 1e-9);
  EXPECT_GT(largest_pitch, 0.02);
}

}  // namespace
}  // namespace sightline::simulation
