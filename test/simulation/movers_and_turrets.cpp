// Things that move beside the robots, and scanners that turn on them.
#include <cmath>

#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/geometry/isometry.h"
#include "sightline/motion/sensor_head.h"
#include "simulation/all_round_view.h"

namespace sightline::simulation {
namespace {

using geometry::Pose2;
using test::allRound;
using test::lastSweeps;
using test::nearestOf;
using test::straight;

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
  Scanner scanner(profile, mounting, 1);
  scanner.mountOn([&](std::int64_t time) { return rate * 1e-9 * static_cast<double>(time); });
  const auto scan = scanner.sweep(world, 400'000'000, [](std::int64_t) { return Pose2(); });
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double time = 0.4 + scan.geometry()->timeOffsets()[i];
    const double direction = scan.geometry()->angles()[i] + rate * time;
    EXPECT_NEAR(scan.ranges()[i] * std::sin(direction), 2.0, 1e-5);
  }
}

TEST(Turret, TurnsAsItIsTold) {
  Simulation simulation(world::World(), {}, Pose2(), 1);
  const motion::HeadLimits limits;
  simulation.carrier().addScanner(allRound(), {}, limits);
  motion::SensorHead head(limits);
  const motion::HeadCommand command{motion::HeadCommand::Mode::kPosition, 0.7, 1.0};
  simulation.carrier().commandTurret(0, command);
  head.command(command);
  while (simulation.time() < 1'500'000'000) {
    const auto outputs = simulation.step();
    ASSERT_EQ(outputs.turrets.size(), 1U);
    for (int i = 0; i < 5; ++i) head.step(1e-3);
    EXPECT_NEAR(outputs.turrets[0].angle, head.angle(), 1e-9);
    EXPECT_EQ(outputs.turrets[0].stamp, simulation.time());
    const Eigen::Isometry3d T_base_sensor =
        simulation.carrier().T_base_sensor(0, simulation.time());
    EXPECT_NEAR(geometry::inPlane(T_base_sensor).theta(), head.angle(), 1e-9);
  }
  EXPECT_NEAR(head.angle(), 0.7, limits.resolution);
}

}  // namespace
}  // namespace sightline::simulation
