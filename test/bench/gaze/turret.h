#pragma once

#include <algorithm>
#include <string>

#include "bench/figures.h"
#include "bench/gaze/triangulation.h"
#include "sightline/config/fields.h"
#include "sightline/config/node.h"
#include "sightline/driver/head_joint.h"

namespace sightline::bench {

/// The file of parameters that turret.launch gives to the node gaze.
struct TurretSettings {
  std::string mount_frame, joint, range_scan;
  gaze::GazeConfig gaze;

  void visit(config::FieldVisitor& visitor) {
    visitor.text("mount_frame", mount_frame, "");
    visitor.text("joint", joint, "");
    visitor.text("range_scan", range_scan, "");
    gaze.visit(visitor);
  }
};

inline gaze::GazeConfig turretGaze(gaze::GazeMode mode) {
  TurretSettings config;
  config::read(config::Node::readFile(SIGHTLINE_SOURCE_DIR "/config/gaze_turret.yaml"), config);
  config.gaze.mode = mode;
  return config.gaze;
}

/// The scanner of jensfelt on the turret of turret.launch, tracked with the shipped settings.
inline PoseSpread turretSpread(const GazePlace& place, gaze::GazeMode mode, std::uint64_t seed) {
  const std::string shipped = SIGHTLINE_SOURCE_DIR "/config/";
  pipeline::EstimatorsConfig config;
  config.rooms.emplace();
  config.rooms->map = shipped + "rooms/" + place.name + ".yaml";
  config.rooms->initial_pose = place.start;
  config.rooms->initial_sigma = {0.05, 0.02};
  const auto world = world::World::readFile(shipped + "worlds/" + place.name + ".yaml");
  test::SimulatedDrive drive(world, simulation::RobotConfig{}, place.start, seed, config,
                             {false, true, false, false});
  simulation::Mounting mounting;
  mounting.x = 0.1;
  mounting.z = 0.4;
  const driver::HeadFrames frames{"turret_joint", "turret_mount", "turret", "laser"};
  drive.addTurret(
      simulation::ScannerProfile::readFile(shipped + "sensors/sick_pls200.yaml"), mounting,
      driver::HeadJoint::readFile(SIGHTLINE_SOURCE_DIR "/urdf/turret.urdf", frames).limits);
  gaze::GazeControl gaze(turretGaze(mode));
  gaze.setMounting({0.1, 0.0, 0.0});
  gaze.setMap(world::RoomMap::readFile(config.rooms->map));
  drive.listen([&gaze](const simulation::Outputs& outputs) {
    for (const auto& state : outputs.states) gaze.takeOdometry(state.stamp, state.pose.mean);
    for (const auto& turret : outputs.turrets) gaze.takeHead(turret.stamp, turret.angle);
  });
  drive.carrier().follow(pathOf(place.path));
  PoseSpread spread;
  while (drive.time() < place.seconds) {
    drive.step([&](const pipeline::Estimates& estimates, const geometry::Pose2& truth) {
      if (!estimates.rooms) return;
      const geometry::UncertainPose2& pose = estimates.rooms->pose;
      gaze.takePose(estimates.located.scan.stamp, pose);
      spread.sigmas += std::sqrt(pose.covariance.topLeftCorner<2, 2>().trace());
      spread.errors += (pose.mean.translation() - truth.translation()).norm();
      spread.scans += 1.0;
    });
    const std::int64_t now = drive.simulation().time();
    if (now % 20'000'000 != 0) continue;
    if (const auto command = gaze.decide(now)) drive.carrier().commandTurret(0, *command);
  }
  return spread;
}

inline void turret(std::uint64_t seeds) {
  for (const GazePlace& place : kGazePlaces) {
    PoseSpread ahead, inform;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      for (auto [mode, sum] : {std::pair{gaze::GazeMode::kHold, &ahead},
                               std::pair{gaze::GazeMode::kInform, &inform}}) {
        const PoseSpread spread = turretSpread(place, mode, seed);
        sum->sigmas += spread.sigmas;
        sum->errors += spread.errors;
        sum->scans += spread.scans;
      }
    }
    const std::string name = std::string("gaze.turret.") + place.name + ".";
    print(name + "ahead.sigma", ahead.sigma(), "m");
    print(name + "ahead.error", ahead.error(), "m");
    print(name + "inform.sigma", inform.sigma(), "m");
    print(name + "inform.error", inform.error(), "m");
    print(name + "sigma_ratio", inform.sigma() / ahead.sigma(), "1");
    print(name + "error_ratio", inform.error() / ahead.error(), "1");
  }
}

}  // namespace sightline::bench
