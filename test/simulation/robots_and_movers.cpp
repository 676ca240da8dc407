// Several robots and other things that move, in one simulation.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/simulation/simulation.h"

namespace sightline::simulation {
namespace {

using geometry::Pose2;

ScannerProfile allRound() {
  ScannerProfile profile;
  profile.beams = 361;
  profile.angle_min = -geometry::kPi;
  profile.angle_max = geometry::kPi;
  profile.revolution = 0.0;
  profile.resolution = 0.0;
  profile.noise.sigma = 1e-6;  // the least that there is
  profile.noise.kind = scan::NoiseKind::kConstant;
  return profile;
}

Path straight(const Eigen::Vector2d& to, double speed) {
  Path path;
  path.speed = speed;
  path.waypoints_map = {to};
  return path;
}

// Nearest range of a sweep, and the bearing that it has.
std::pair<double, double> nearestOf(const scan::Scan& scan) {
  const auto nearest = std::min_element(scan.ranges().begin(), scan.ranges().end());
  const auto beam = static_cast<std::size_t>(nearest - scan.ranges().begin());
  return {*nearest, scan.geometry()->angles()[beam]};
}

// Latest sweep of each robot, by the robot's index.
std::vector<scan::Scan> lastSweeps(Simulation& simulation, double seconds) {
  std::vector<std::optional<scan::Scan>> last(simulation.robots());
  const auto end = simulation.time() + std::llround(1e9 * seconds);
  while (simulation.time() < end) {
    for (auto& sweep : simulation.step().sweeps) last[sweep.robot] = std::move(sweep.scan);
  }
  std::vector<scan::Scan> result;
  for (auto& scan : last) result.push_back(std::move(scan.value()));
  return result;
}

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

TEST(Movers, FollowTheirPathAndAreSeen) {
  Simulation simulation(world::World(), 1);
  Mounting mounting;
  mounting.z = 0.4;
  simulation.addRobot({}, Pose2()).addScanner(allRound(), mounting);
  Body person;
  person.radius = 0.2;
  person.top = 1.75;
  simulation.addMover(person, straight({-2.0, 2.0}, 1.0), Pose2(3.0, 2.0, geometry::kPi));
  EXPECT_NEAR(nearestOf(lastSweeps(simulation, 0.05)[0]).first, std::hypot(3.0, 2.0) - 0.2, 0.01);
  EXPECT_NEAR(nearestOf(lastSweeps(simulation, 20.0)[0]).first, std::hypot(2.0, 2.0) - 0.2, 0.03);
}

TEST(Movers, ArePiecesThatTurnWithThem) {
  Simulation simulation(world::World(), 1);
  Mounting mounting;
  mounting.z = 0.4;
  simulation.addRobot({}, Pose2()).addScanner(allRound(), mounting);
  Body board;
  board.radius = 0.0;
  board.width = 1.0;
  board.bottom = 0.3;
  simulation.addMover(board, straight({2.0, 0.0}, 1.0), Pose2(2.0, 0.0, 0.0));
  const scan::Scan scan = lastSweeps(simulation, 0.1)[0];
  std::size_t seen = 0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    ++seen;
    EXPECT_NEAR(scan.point(i).x(), 2.0, 1e-5);
    EXPECT_LT(std::abs(scan.point(i).y()), 0.5);
  }
  EXPECT_EQ(seen, 29u) << "2 * atan(0.5 / 2) / 1 degree, and the one in the middle";
}

TEST(Movers, GoRoundWhereTheirPathRepeats) {
  Path path;
  path.speed = 1.0;
  path.turn_rate = 3.0;
  path.repeat = true;
  path.waypoints_map = {{2.0, 0.0}, {0.0, 0.0}};
  Mover mover(path, Pose2());
  int turns = 0;
  bool is_out = true;
  for (std::int64_t time = 0; time < 60'000'000'000; time += Carrier::kStep) {
    mover.moveTo(time + Carrier::kStep);
    const double x = mover.T_map_body(time + Carrier::kStep).x();
    ASSERT_GT(x, -1.0);
    ASSERT_LT(x, 3.0);
    if (is_out ? x > 1.6 : x < 0.4) {
      is_out = !is_out;
      ++turns;
    }
  }
  EXPECT_GT(turns, 15);
}

TEST(Movers, NeedABodyThatFits) {
  Simulation simulation(world::World(), 1);
  Body body;
  body.bottom = 2.0;
  EXPECT_EQ(test::errorOf([&] { simulation.addMover(body, {}, Pose2()); }).key(), "bottom");
}

TEST(Turret, TurnsAtItsRateAndTheScanWithIt) {
  const double rate = geometry::radians(90.0);
  world::World world;
  world.add(world::WorldDisc{{0.0, 3.0}, 0.1, 0.0, 2.0, 0});
  Simulation simulation(world, {}, Pose2(), 1);
  Mounting mounting;
  mounting.x = 0.2;
  mounting.z = 0.4;
  mounting.yaw = 0.3;
  simulation.carrier().addScanner(allRound(), mounting, rate);
  std::size_t sweeps = 0;
  while (simulation.time() < 1'000'000'000) {
    for (const auto& sweep : simulation.step().sweeps) {
      const Eigen::Isometry3d T_base_sensor =
          simulation.carrier().T_base_sensor(0, sweep.scan.stamp);
      const double turned = 0.3 + rate * 1e-9 * static_cast<double>(sweep.scan.stamp);
      EXPECT_TRUE(T_base_sensor.translation().isApprox(Eigen::Vector3d(0.2, 0.0, 0.4), 1e-12));
      EXPECT_NEAR(T_base_sensor.linear()(1, 0), std::sin(turned), 1e-12);
      const auto [range, bearing] = nearestOf(sweep.scan);
      const Eigen::Vector3d point = T_base_sensor * Eigen::Vector3d(range * std::cos(bearing),
                                                                    range * std::sin(bearing), 0.0);
      EXPECT_NEAR((point.head<2>() - Eigen::Vector2d(0.0, 3.0)).norm(), 0.1, 1e-5);
      ++sweeps;
    }
  }
  EXPECT_EQ(sweeps, 41u);
}

// Turns within the sweep, beam by beam.
TEST(Turret, MovesEveryBeamAtItsOwnTime) {
  const double rate = geometry::radians(90.0);
  ScannerProfile profile = allRound();
  profile.revolution = 0.1;
  profile.rate = 10.0;
  world::World world;
  world.add(world::WorldSegment{{{-20.0, 2.0}, {20.0, 2.0}}, 0.0, 2.0, 0});
  Mounting mounting;
  mounting.z = 0.4;
  Scanner scanner(profile, mounting, 1, rate);
  const auto scan = scanner.sweep(world, 400'000'000, [](std::int64_t) { return Pose2(); });
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double time = 0.4 + scan.geometry()->timeOffsets()[i];
    const double direction = scan.geometry()->angles()[i] + rate * time;
    EXPECT_NEAR(scan.ranges()[i] * std::sin(direction), 2.0, 1e-5);
  }
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
