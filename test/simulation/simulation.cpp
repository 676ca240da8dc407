#include "sightline/simulation/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sightline::simulation {
namespace {

using geometry::Pose2;

world::World box(double half) {
  world::World world;
  const std::vector<Eigen::Vector2d> corners{
      {-half, -half}, {half, -half}, {half, half}, {-half, half}};
  for (std::size_t i = 0; i < 4; ++i) {
    world.add(world::WorldSegment{{corners[i], corners[(i + 1) % 4]}, 0.0, 2.0, 0});
  }
  return world;
}

Path pathOf(const std::string& text) {
  return Path(config::Node::parse(text, "path.yaml"));
}

void run(Simulation& simulation, double seconds) {
  const auto end = simulation.time() + std::llround(seconds * 1e9);
  while (simulation.time() < end) simulation.step();
}

TEST(Robot, KeepsItsLimits) {
  RobotConfig config;
  Robot robot(config, {}, 1);
  Velocity before;
  for (int i = 0; i < 2000; ++i) {
    robot.step({5.0, -9.0}, 0.005);
    EXPECT_LE(robot.velocity().linear - before.linear, config.acceleration * 0.005 + 1e-12);
    before = robot.velocity();
  }
  EXPECT_DOUBLE_EQ(robot.velocity().linear, config.max_speed);
  EXPECT_DOUBLE_EQ(robot.velocity().angular, -config.max_turn_rate);
}

TEST(Robot, DrivesArcs) {
  RobotConfig config;
  config.acceleration = config.turn_acceleration = 1e6;
  Robot robot(config, Pose2(1.0, 2.0, 0.5), 1);
  for (int i = 0; i < 400; ++i) robot.step({0.5, 0.4}, 0.005);
  const Pose2 expected = Pose2(1.0, 2.0, 0.5) * Pose2::exp({1.0, 0.0, 0.8});
  EXPECT_TRUE(robot.T_map_base().coordinates().isApprox(expected.coordinates(), 1e-9));
}

TEST(Simulation, StopsWhenCommandsCeaseToCome) {
  RobotConfig config;
  Simulation simulation(box(50.0), config, {}, 1);
  simulation.carrier().command({0.4, 0.3});
  run(simulation, 0.45);
  EXPECT_GT(simulation.robot().velocity().linear, 0.2);
  simulation.carrier().command({0.4, 0.3});
  run(simulation, 0.45);
  EXPECT_DOUBLE_EQ(simulation.robot().velocity().linear, 0.4) << "the second one renewed it";
  run(simulation, config.command_timeout + 0.4 / config.acceleration);
  EXPECT_EQ(simulation.robot().velocity().linear, 0.0);
  EXPECT_EQ(simulation.robot().velocity().angular, 0.0);
}

TEST(Simulation, FollowsAPathThroughItsWaypointsAndStaysAtTheEnd) {
  const Path path = pathOf(
      "{speed: 0.6, turn_rate: 0.8, tolerance: 0.25, waypoints: [[3, 0], [3, -3], [-2, -3]]}");
  Simulation simulation(box(50.0), {}, Pose2(0.0, 0.0, 2.0), 1);
  simulation.carrier().follow(path);
  std::vector<double> nearest(3, 1e9);
  double fastest = 0.0;
  for (int i = 0; i < 40 * 200; ++i) {
    simulation.step();
    for (std::size_t w = 0; w < 3; ++w) {
      const Eigen::Vector2d to = path.waypoints_map[w];
      nearest[w] =
          std::min(nearest[w], (simulation.robot().T_map_base().translation() - to).norm());
    }
    fastest = std::max(fastest, simulation.robot().velocity().linear);
    EXPECT_LE(std::abs(simulation.robot().velocity().angular), 0.8);
  }
  EXPECT_THAT(nearest, testing::Each(testing::Le(0.25)));
  EXPECT_NEAR(fastest, 0.6, 1e-6);
  const Pose2 end = simulation.robot().T_map_base();
  EXPECT_LT((end.translation() - path.waypoints_map[2]).norm(), 0.05);
  simulation.carrier().command({1.0, 0.0});
  run(simulation, 2.0);
  EXPECT_EQ(simulation.robot().T_map_base().coordinates(), end.coordinates());
}

TEST(Simulation, SetsOffOnceItHasWaited) {
  Simulation simulation(box(50.0), {}, {}, 1);
  simulation.carrier().follow(pathOf("{wait: 1.5, waypoints: [[3, 0]]}"));
  run(simulation, 1.5);
  EXPECT_EQ(simulation.robot().T_map_base().x(), 0.0);
  run(simulation, 0.1);
  EXPECT_GT(simulation.robot().T_map_base().x(), 0.0);
}

TEST(Simulation, SweepsComeAtTheirRateOnceTheyEnded) {
  Simulation simulation(box(5.0), {}, {}, 1);
  ScannerProfile profile;
  profile.beams = 31;
  simulation.carrier().addScanner(profile, {});
  profile.rate = 3.0;
  simulation.carrier().addScanner(profile, {});
  std::vector<std::vector<std::int64_t>> stamps(2);
  while (simulation.time() < 2'000'000'000) {
    for (const FinishedSweep& sweep : simulation.step().sweeps) {
      const auto duration = std::llround(profile.sweepDuration() * 1e9);
      EXPECT_LE(sweep.scan.stamp + duration, simulation.time());
      EXPECT_GT(sweep.scan.stamp + duration, simulation.time() - Simulation::kStep);
      stamps[sweep.scanner].push_back(sweep.scan.stamp);
    }
  }
  ASSERT_EQ(stamps[0].size(), 80u);
  ASSERT_EQ(stamps[1].size(), 6u);
  for (std::size_t i = 0; i < 80; ++i) {
    EXPECT_EQ(stamps[0][i], 25'000'000 * static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(stamps[1][1], 333'333'333);
}

TEST(Simulation, SameSeedSameRunWhateverElseIsMounted) {
  const auto ranges = [](std::uint64_t seed, bool second) {
    Simulation simulation(box(5.0), {}, {}, seed);
    ScannerProfile profile;
    profile.beams = 31;
    simulation.carrier().addScanner(profile, {});
    if (second) simulation.carrier().addScanner(profile, {});
    simulation.carrier().command({0.5, 0.2});
    std::vector<double> all;
    while (simulation.time() < 500'000'000) {
      for (const FinishedSweep& sweep : simulation.step().sweeps) {
        if (sweep.scanner == 0)
          all.insert(all.end(), sweep.scan.ranges().begin(), sweep.scan.ranges().end());
      }
    }
    const auto odometry = simulation.robot().odometry().pose().mean.coordinates();
    all.insert(all.end(), odometry.begin(), odometry.end());
    return all;
  };
  EXPECT_EQ(ranges(1, false), ranges(1, true));
  EXPECT_NE(ranges(1, false), ranges(2, false));
}

TEST(Simulation, ScannersDoNotShareTheirNoise) {
  Simulation simulation(box(5.0), {}, {}, 1);
  simulation.carrier().addScanner({}, {});
  simulation.carrier().addScanner({}, {});
  std::vector<scan::Scan> scans;
  while (scans.size() < 2) {
    for (auto& sweep : simulation.step().sweeps) scans.push_back(std::move(sweep.scan));
  }
  EXPECT_NE(scans[0].ranges(), scans[1].ranges());
}

TEST(Path, TourOfTheFloorKeepsClearOfEverythingAndEndsInTheLabWithinAMinute) {
  const std::string folder = SIGHTLINE_SOURCE_DIR "/config/";
  const world::World floor = world::World::readFile(folder + "worlds/floor.yaml");
  const auto rooms = world::RoomMap::readFile(folder + "rooms/floor.yaml");
  Simulation simulation(world::World{}, {}, Pose2(-2.2, 4.6, 0.2), 1);
  simulation.carrier().follow(Path::readFile(folder + "paths/floor_tour.yaml"));
  std::vector<std::string> visited;
  while (simulation.time() < 58'000'000'000) {
    simulation.step();
    const Eigen::Vector2d position = simulation.robot().T_map_base().translation();
    for (const auto& s : floor.segments()) ASSERT_GT(s.segment.distance(position), 0.4);
    for (const auto& d : floor.discs()) ASSERT_GT((d.centre - position).norm() - d.radius, 0.4);
    const auto room = rooms.roomAt(position);
    if (!room) continue;  // in a door
    const std::string& name = rooms.rooms()[*room].name;
    if (visited.empty() || visited.back() != name) visited.push_back(name);
  }
  EXPECT_THAT(visited, testing::ElementsAre("living_room", "corridor", "manipulator_lab"));
  EXPECT_EQ(simulation.robot().velocity().linear, 0.0);
}

TEST(Path, ErrorsNameFileLineAndKey) {
  const auto errorOf = [](const std::string& text) -> std::string {
    try {
      pathOf(text);
    } catch (const config::Error& error) {
      return error.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  EXPECT_THAT(errorOf("speed: 1"), HasSubstr("path.yaml:1: missing key 'waypoints'"));
  EXPECT_THAT(errorOf("waypoints: [[1, 2]]\nspeed: -1"), HasSubstr("path.yaml:2: speed: -1 is"));
  EXPECT_THAT(errorOf("waypoints:\n  - [1, 2]\n  - [1]"),
              HasSubstr("path.yaml:3: waypoints[1]: expected 2 numbers"));
  EXPECT_THAT(errorOf("waypoints: []\nspeeed: 1"), HasSubstr("unknown key"));
}

TEST(Path, AnEmptyOneStaysWhereItIs) {
  PathFollower follower(pathOf("waypoints: []"), 0.5);
  EXPECT_TRUE(follower.hasArrived());
  EXPECT_EQ(follower.steer({}).linear, 0.0);
}

}  // namespace
}  // namespace sightline::simulation
