#include "sightline/motion/floor.h"
#include "sightline/geometry/isometry.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sightline/motion/floor_finder.h"
#include "sightline/simulation/simulation.h"

namespace sightline::motion {
namespace {

using geometry::Pose2;
using geometry::radians;

simulation::ScannerProfile profile() {
  simulation::ScannerProfile profile;
  profile.beams = 361;
  profile.angle_min = radians(-90.0);
  profile.angle_max = radians(90.0);
  profile.rate = 5.0;
  profile.revolution = 0.0266;
  profile.noise.sigma = 0.01;
  return profile;
}

// A corridor of 24 by 2.2 m below a ceiling of 2.6 m.
world::World corridor() {
  world::World world;
  world.add(world::WorldPlate{{}, 0.0, 0});
  world.add(world::WorldPlate{{}, 2.6, 0});
  const std::vector<Eigen::Vector2d> corners{{-2.0, -1.1}, {22.0, -1.1}, {22.0, 1.1}, {-2.0, 1.1}};
  for (std::size_t i = 0; i < 4; ++i) {
    world::WorldSegment segment;
    segment.segment = {corners[i], corners[(i + 1) % 4]};
    segment.top = 2.6;
    world.add(segment);
  }
  return world;
}

Eigen::Isometry3d leaning(const Pose2& T_map_base, const geometry::Attitude& attitude) {
  simulation::BodyMotion motion;
  motion.attitude = attitude;
  return geometry::inSpace(T_map_base) * motion.outOfPlane(1.2);
}

simulation::Mounting atBreastHeight() {
  simulation::Mounting mounting;
  mounting.z = 1.2;
  return mounting;
}

// One sweep of a person who stands still.
scan::Scan lookInto(const world::World& world, const Pose2& T_map_base,
                    const geometry::Attitude& attitude) {
  simulation::ScannerProfile exact = profile();
  exact.noise.sigma = 1e-6;
  exact.resolution = 0.0;
  simulation::Scanner scanner(exact, atBreastHeight(), 1);
  return scanner.sweepInSpace(world, 0,
                              [&](std::int64_t) { return leaning(T_map_base, attitude); });
}

long count(const std::vector<bool>& beams) {
  return std::count(beams.begin(), beams.end(), true);
}

TEST(BeamsOnFloor, AreThoseThatCameAsFarAsTheFloor) {
  const geometry::Attitude attitude{0.0, radians(10.0)};
  const auto scan = lookInto(corridor(), Pose2(), attitude);
  const auto on_floor = beamsOnFloor({}, scan, {attitude, attitude});
  EXPECT_NEAR(scan.ranges()[180], 6.91, 0.01);
  EXPECT_TRUE(on_floor[180]);
  const auto beam = static_cast<std::size_t>(180 + 16);
  EXPECT_NEAR(scan.ranges()[beam], 1.2 / (std::sin(radians(10.0)) * std::cos(radians(8.0))), 1e-3);
  EXPECT_TRUE(on_floor[beam]);
  EXPECT_FALSE(on_floor[180 + 60]) << "at 30 degrees the wall is nearer";
  // The floor is nearer than the wall within 9 degrees; two sigma of the tilt make that a little
  // more.
  EXPECT_NEAR(static_cast<double>(count(on_floor)), 37.0, 5.0);
}

TEST(BeamsOnFloor, LeaningBackTheyAreOnTheCeiling) {
  const geometry::Attitude attitude{0.0, radians(-9.0)};
  const auto scan = lookInto(corridor(), Pose2(), attitude);
  FloorConfig config;
  config.headroom = 1.4;
  EXPECT_NEAR(scan.ranges()[180], 1.4 / std::sin(radians(9.0)), 1e-3);
  EXPECT_TRUE(beamsOnFloor(config, scan, {attitude, attitude})[180]);
}

TEST(BeamsOnFloor, ALevelScanHasNone) {
  EXPECT_EQ(count(beamsOnFloor({}, lookInto(corridor(), Pose2(), {}), {})), 0);
}

TEST(BeamsOnFloor, TheAttitudeChangesDuringTheSweep) {
  simulation::ScannerProfile exact = profile();
  exact.noise.sigma = 1e-6;
  simulation::Scanner scanner(exact, atBreastHeight(), 1);
  const auto duration = static_cast<double>(scanner.sweepDuration());
  const geometry::Attitude first{0.0, radians(4.0)};
  const geometry::Attitude last{0.0, radians(10.0)};
  const auto scan = scanner.sweepInSpace(corridor(), 0, [&](std::int64_t time) {
    const double share = static_cast<double>(time) / duration;
    return leaning(Pose2(), {0.0, first.pitch + share * (last.pitch - first.pitch)});
  });
  EXPECT_NEAR(scan.ranges()[180], 1.2 / std::sin(radians(7.0)), 0.01);
  EXPECT_TRUE(beamsOnFloor({}, scan, {first, last})[180]);
  EXPECT_FALSE(beamsOnFloor({}, scan, {first, first})[180]);
}

TEST(Levelled, WallsAreWhereALevelScannerSeesThem) {
  for (const geometry::Attitude attitude :
       {geometry::Attitude{0.0, 0.15}, {0.1, 0.0}, {-0.08, -0.12}}) {
    const auto scan = lookInto(corridor(), Pose2(0.0, 0.2, 0.1), attitude);
    const auto level = levelled(scan, {attitude, attitude});
    EXPECT_NEAR(level.ranges()[180] * level.geometry()->cosines()[180],
                scan.ranges()[180] * std::cos(attitude.pitch), 1e-9);
    int walls = 0;
    for (std::size_t i = 0; i < level.beams(); ++i) {
      const Eigen::Vector2d point = Pose2(0.0, 0.2, 0.1) * level.point(i);
      if (point.x() > 5.0) continue;  // farther off the floor may be nearer than the wall
      ++walls;
      const double off = std::min(std::abs(std::abs(point.y()) - 1.1), std::abs(point.x() + 2.0));
      EXPECT_LT(off, 1e-4) << i;
    }
    EXPECT_GT(walls, 250);
  }
}

TEST(Levelled, AnUprightScanStaysAsItIs) {
  const auto scan = lookInto(corridor(), Pose2(), {});
  const auto level = levelled(scan, {});

  for (std::size_t i = 0; i < scan.beams(); ++i) {
    EXPECT_NEAR(level.ranges()[i], scan.ranges()[i], 1e-12 * scan.ranges()[i]);
    EXPECT_NEAR(level.geometry()->angles()[i], scan.geometry()->angles()[i], 1e-12);
  }
}

TEST(Without, MakesBeamsInvalid) {
  const auto scan = lookInto(corridor(), Pose2(), {});
  std::vector<bool> beams(scan.beams());
  beams[17] = true;
  const auto rest = without(scan, beams);
  EXPECT_EQ(rest.kinds()[17], scan::ReturnKind::kInvalid);
  EXPECT_EQ(rest.kinds()[18], scan::ReturnKind::kValid);
}

// Numbers of beams that are called what they are, and of the others.
struct Calls {
  long found = 0;
  long missed = 0;
  long mistaken = 0;
};

// Walks along the corridor and asks about every scan, at the true pose.
Calls walk(bool nods, std::uint64_t seed) {
  const world::World world = corridor();
  simulation::RobotConfig robot;
  robot.max_speed = 1.3;
  simulation::Simulation simulation(world, robot, Pose2(), seed);
  if (nods) simulation.carrier().walk({});
  simulation.carrier().addScanner(profile(), atBreastHeight());
  FloorFinder finder(FloorConfig{});
  Calls calls;
  while (simulation.robot().T_map_base().x() < 15.0) {
    simulation.carrier().command({1.3, 0.0});
    for (const auto& [robot_index, scanner, scan] : simulation.step().sweeps) {
      const Pose2 T_map_sensor = simulation.carrier().T_map_base(scan.stamp);
      const auto found = finder.find(scan, T_map_sensor);
      finder.remember(scan, T_map_sensor);
      for (std::size_t i = 0; i < scan.beams(); ++i) {
        const auto time = scan.stamp + std::llround(1e9 * scan.geometry()->timeOffsets()[i]);
        const Eigen::Isometry3d T_map_scanner =
            geometry::inSpace(simulation.carrier().T_map_base(time)) *
            simulation.carrier().bodyMotion(time).outOfPlane(1.2) *
            Eigen::Translation3d(0.0, 0.0, 1.2);
        const Eigen::Vector3d ray(scan.geometry()->cosines()[i], scan.geometry()->sines()[i], 0.0);
        const auto hit = world.cast({T_map_scanner.translation(), T_map_scanner.linear() * ray});
        const bool is_floor = hit && !hit->segment && scan.isValid(i);
        calls.found += is_floor && found[i];
        calls.missed += is_floor && !found[i];
        calls.mistaken += !is_floor && found[i];
      }
    }
  }
  return calls;
}

TEST(FloorFinder, TellsFloorAndCeilingFromWallsWithoutKnowingTheAttitude) {
  Calls all;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Calls calls = walk(/*nods=*/true, seed);
    all.found += calls.found;
    all.missed += calls.missed;
    all.mistaken += calls.mistaken;
  }
  EXPECT_GT(all.found, 1000);
  EXPECT_GT(static_cast<double>(all.found), 0.9 * static_cast<double>(all.found + all.missed));
  EXPECT_GT(static_cast<double>(all.found), 0.95 * static_cast<double>(all.found + all.mistaken));
}

TEST(FloorFinder, FindsNoneWhereTheCarrierKeepsLevel) {
  const Calls calls = walk(/*nods=*/false, 1);
  EXPECT_EQ(calls.found + calls.missed, 0);
  EXPECT_EQ(calls.mistaken, 0);
}

TEST(FloorFinder, KnowsNothingBeforeItRemembersAnything) {
  const FloorFinder finder(FloorConfig{});
  const auto scan = lookInto(corridor(), Pose2(), {0.0, radians(9.0)});
  EXPECT_EQ(count(finder.find(scan, Pose2())), 0);
}

TEST(FloorFinder, TakesScansWithoutReturnsAndOfFewBeams) {
  FloorFinder finder(FloorConfig{});
  auto scan = lookInto(corridor(), Pose2(), {});
  for (std::size_t i = 0; i < scan.beams(); ++i) scan.setKind(i, scan::ReturnKind::kInvalid);
  finder.remember(scan, Pose2());
  EXPECT_EQ(count(finder.find(scan, Pose2())), 0);
  const scan::Scan one(scan::ScanGeometry::uniform(0.0, 0.1, 1, 0.0, 0.1, 30.0), 0, {10.0});
  finder.remember(one, Pose2());
  EXPECT_EQ(count(finder.find(lookInto(corridor(), Pose2(), {}), Pose2())), 0);
  EXPECT_EQ(count(finder.find(one, Pose2())), 0);
}

TEST(FloorFinder, RefusesSettingsOutOfRange) {
  FloorConfig config;
  config.memory = 0;
  EXPECT_THROW(FloorFinder{config}, config::Error);
}

}  // namespace
}  // namespace sightline::motion
