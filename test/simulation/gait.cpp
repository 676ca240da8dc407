#include "sightline/simulation/gait.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sightline/simulation/simulation.h"

namespace sightline::simulation {
namespace {

using geometry::Pose2;
using geometry::radians;

constexpr double kStep = 0.005;  // s

std::vector<BodyMotion> walk(const GaitConfig& config, double speed, double seconds,
                             std::uint64_t seed = 1) {
  Gait gait(config, seed);
  std::vector<BodyMotion> motions;
  for (double t = 0.0; t < seconds; t += kStep) {
    gait.step(speed, kStep);
    motions.push_back(gait.motion());
  }
  return motions;
}

double largestPitch(const std::vector<BodyMotion>& motions) {
  double largest = 0.0;
  for (const BodyMotion& m : motions) largest = std::max(largest, std::abs(m.attitude.pitch));
  return largest;
}

int risingCrossings(const std::vector<double>& values) {
  int count = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i - 1] < 0.0 && values[i] >= 0.0) ++count;
  }
  return count;
}

TEST(Gait, PitchesOnceAStepAndRollsOnceInTwo) {
  GaitConfig config;
  config.lean = 0.0;
  std::vector<double> pitch;
  std::vector<double> roll;
  for (const BodyMotion& m : walk(config, config.speed, 60.0)) {
    pitch.push_back(m.attitude.pitch);
    roll.push_back(m.attitude.roll);
  }
  EXPECT_NEAR(risingCrossings(pitch), 60.0 * config.step_rate, 2.0);
  EXPECT_NEAR(risingCrossings(roll), 30.0 * config.step_rate, 2.0);
}

TEST(Gait, ReachesItsAmplitudesAndNeverMore) {
  const GaitConfig config;
  const double largest = largestPitch(walk(config, config.speed, 300.0));
  EXPECT_LE(largest, config.lean + config.pitch);
  EXPECT_GT(largest, 0.95 * (config.lean + config.pitch));
}

TEST(Gait, StandsStillWithThePerson) {
  EXPECT_EQ(largestPitch(walk({}, 0.0, 5.0)), 0.0);
  Gait gait({}, 1);
  for (int i = 0; i < 1000; ++i) gait.step(1.3, kStep);
  for (int i = 0; i < 1000; ++i) gait.step(0.0, kStep);
  EXPECT_LT(std::abs(gait.motion().attitude.pitch), 1e-6);
  EXPECT_LT(std::abs(gait.motion().sway), 1e-6);
}

TEST(Gait, IsTheSameForTheSameSeedOnly) {
  const auto one = walk({}, 1.3, 10.0, 1).back();
  EXPECT_EQ(one.attitude.pitch, walk({}, 1.3, 10.0, 1).back().attitude.pitch);
  EXPECT_NE(one.attitude.pitch, walk({}, 1.3, 10.0, 2).back().attitude.pitch);
}

TEST(BodyMotion, LeansAboutItsHeight) {
  BodyMotion motion;
  motion.bob = 0.02;
  motion.attitude = {0.05, 0.1};
  const Eigen::Vector3d pivot = motion.outOfPlane(1.2) * Eigen::Vector3d(0.0, 0.0, 1.2);
  EXPECT_TRUE(pivot.isApprox(Eigen::Vector3d(0.0, 0.0, 1.22)));
}

ScannerProfile exactScanner() {
  ScannerProfile profile;
  profile.beams = 361;
  profile.angle_min = radians(-90.0);
  profile.angle_max = radians(90.0);
  profile.revolution = 0.0;
  profile.rate = 5.0;
  profile.resolution = 0.0;
  profile.noise.sigma = 1e-6;
  return profile;
}

world::World floorAndCeiling() {
  world::World world;
  world.add(world::WorldPlate{{}, 0.0, 0});
  world.add(world::WorldPlate{{}, 2.6, 0});
  return world;
}

Mounting atBreastHeight() {
  Mounting mounting;
  mounting.z = 1.2;
  return mounting;
}

TEST(BodyWorn, LeaningForwardTheBeamAheadMeetsTheFloor) {
  BodyMotion motion;
  motion.attitude.pitch = radians(10.0);
  Scanner scanner(exactScanner(), atBreastHeight(), 1);
  const auto scan = scanner.sweepInSpace(floorAndCeiling(), 0,
                                         [&](std::int64_t) { return motion.outOfPlane(1.2); });
  for (const double bearing : {-60.0, 0.0, 30.0}) {
    const auto beam = static_cast<std::size_t>(std::lround(2.0 * bearing)) + 180;
    const double expected = 1.2 / (std::sin(radians(10.0)) * std::cos(radians(bearing)));
    EXPECT_NEAR(scan.ranges()[beam], expected, 1e-3) << bearing;
  }
  EXPECT_NEAR(scan.ranges()[180], 6.91, 0.01);
}

// Every return of a walk over an endless floor below an endless ceiling tells the attitude.
TEST(BodyWorn, TheAttitudeIsTheOneThatTheScansShow) {
  Simulation simulation(floorAndCeiling(), {}, Pose2(), 7);
  GaitConfig gait;
  gait.speed = 0.8;
  simulation.carrier().walk(gait);
  simulation.carrier().addScanner(exactScanner(), atBreastHeight());
  double steepest = 0.0;
  while (simulation.time() < 20'000'000'000) {
    simulation.carrier().command({0.8, 0.3});
    for (const FinishedSweep& sweep : simulation.step().sweeps) {
      const BodyMotion motion = simulation.carrier().bodyMotion(sweep.scan.stamp);
      const double pitch = motion.attitude.pitch;
      if (std::abs(pitch) < 0.06) continue;  // beyond the scanner's reach
      const double room = pitch > 0.0 ? 1.2 + motion.bob : 1.4 - motion.bob;
      EXPECT_NEAR(sweep.scan.ranges()[180], room / std::abs(std::sin(pitch)), 0.02);
      steepest = std::max(steepest, std::abs(pitch));
    }
  }
  EXPECT_GT(steepest, radians(7.0));
}

TEST(BodyWorn, SwaysAboutTheWay) {
  Simulation simulation(floorAndCeiling(), {}, Pose2(), 7);
  simulation.carrier().walk({});
  double farthest = 0.0;
  double sum = 0.0;
  int steps = 0;
  while (simulation.time() < 30'000'000'000) {
    simulation.carrier().command({1.0, 0.0});
    simulation.step();
    const double y = simulation.carrier().T_map_base(simulation.time()).y();
    farthest = std::max(farthest, std::abs(y));
    sum += y;
    ++steps;
  }
  EXPECT_NEAR(farthest, 0.03 * 1.0 / 1.3, 0.002);
  EXPECT_NEAR(sum / steps, 0.0, 0.002);
}

TEST(BodyWorn, ARobotKeepsLevel) {
  Simulation simulation(floorAndCeiling(), {}, Pose2(1.0, 2.0, 0.3), 7);
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_EQ(simulation.carrier().bodyMotion(simulation.time()).attitude.pitch, 0.0);
  EXPECT_EQ(simulation.carrier().T_map_base(simulation.time()).y(), 2.0);
}

TEST(BodyWorn, RefusesAGaitOutOfRange) {
  Simulation simulation(floorAndCeiling(), {}, Pose2(), 7);
  GaitConfig gait;
  gait.step_rate = 0.0;
  EXPECT_THROW(simulation.carrier().walk(gait), config::Error);
}

}  // namespace
}  // namespace sightline::simulation
