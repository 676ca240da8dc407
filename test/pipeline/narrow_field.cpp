// The sensor of pears, 40 degrees and 2.5 m, under the room tracker in a furnished room.
#include <algorithm>

#include <gtest/gtest.h>

#include "simulated_drive.h"

namespace sightline {
namespace {

const char* const kWay =
    "{speed: 0.3, turn_rate: 0.8, tolerance: 0.2, waypoints: [[0.3, 1.13], [1.2, -0.5], "
    "[3.2, -1.2], [1.2, -1.2], [0, 0], [-1.5, 1.2], [-3.2, 1.4]]}";

double largestErrorOf(double head_angle) {
  const std::string shipped = SIGHTLINE_SOURCE_DIR "/config/";
  const geometry::Pose2 start(-3.2, 1.4, 0.0);
  pipeline::EstimatorsConfig config;
  config.rooms.emplace();
  config.rooms->map = shipped + "rooms/living_room.yaml";
  config.rooms->initial_pose = start;
  config.rooms->initial_sigma = {0.05, 0.02};
  config.rooms->tracker.odometry = simulation::RobotConfig{}.odometry;  // wheels that were measured
  test::SimulatedDrive drive(world::World::readFile(shipped + "worlds/living_room.yaml"), {}, start,
                             1, config, {false, true, false, false});
  simulation::Mounting mounting;
  mounting.x = 0.1;
  mounting.z = 0.4;
  drive.addActiveSensor(
      simulation::ActiveSensorProfile::readFile(shipped + "sensors/synchronised_scan.yaml"),
      mounting);
  drive.carrier().commandHead(0, {motion::HeadCommand::Mode::kPosition, head_angle, 0.0});
  drive.carrier().follow(simulation::Path(config::Node::parse(kWay, "way")));
  double largest = 0.0;
  drive.run(60.0, [&](const pipeline::Estimates& estimates, const geometry::Pose2& truth) {
    if (!estimates.rooms) return;
    const geometry::Pose2& pose = estimates.rooms->pose.mean;
    largest = std::max(largest, (pose.translation() - truth.translation()).norm());
  });
  return largest;
}

// Furniture stands alone in the field as the wall behind it would: it is not taken for that wall.
TEST(NarrowFieldStatistics, RobotIsNotSentAcrossTheRoom) {
  for (const double head_angle : {0.0, 1.57, -1.57}) {
    EXPECT_LT(largestErrorOf(head_angle), 0.35) << "head at " << head_angle << " rad";
  }
}

}  // namespace
}  // namespace sightline
