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

/// What a tracker did with the scanner of jensfelt on the turret of turret.launch.
struct TurretDrive {
  PoseSpread spread;
  double longest_off = 0.0;  // time that the pose was off by the depth of a shelf [s]
};

inline pipeline::EstimatorsConfig turretTracking(const GazePlace& place, tracking::Method method) {
  pipeline::EstimatorsConfig config;
  config.rooms.emplace();
  config.rooms->map = std::string(SIGHTLINE_SOURCE_DIR "/config/rooms/") + place.name + ".yaml";
  config.rooms->initial_pose = place.start;
  config.rooms->initial_sigma = {0.05, 0.02};
  config.rooms->tracker.method = method;
  return config;
}

inline void addTurret(test::SimulatedDrive& drive) {
  const std::string source = SIGHTLINE_SOURCE_DIR;
  simulation::Mounting mounting;
  mounting.x = 0.1;
  mounting.z = 0.4;
  const driver::HeadFrames frames{"turret_joint", "turret_mount", "turret", "laser"};
  drive.addTurret(simulation::ScannerProfile::readFile(source + "/config/sensors/sick_pls200.yaml"),
                  mounting,
                  driver::HeadJoint::readFile(source + "/urdf/turret.urdf", frames).limits);
}

/// Tracked with the shipped settings.
inline TurretDrive turretDrive(const GazePlace& place, const std::string& world_name,
                               gaze::GazeMode mode, tracking::Method method, std::uint64_t seed) {
  constexpr double kShelf = 0.2;  // [m]
  const auto config = turretTracking(place, method);
  const auto world = world::World::readFile(std::string(SIGHTLINE_SOURCE_DIR "/config/worlds/") +
                                            world_name + ".yaml");
  test::SimulatedDrive drive(world, simulation::RobotConfig{}, place.start, seed, config,
                             {false, true, false, false});
  addTurret(drive);
  gaze::GazeControl gaze(turretGaze(mode));
  gaze.setMounting({0.1, 0.0, 0.0});
  gaze.setMap(world::RoomMap::readFile(config.rooms->map));
  drive.listen([&gaze](const simulation::Outputs& outputs) {
    for (const auto& state : outputs.states) gaze.takeOdometry(state.stamp, state.pose.mean);
    for (const auto& turret : outputs.turrets) gaze.takeHead(turret.stamp, turret.angle);
  });
  drive.carrier().follow(pathOf(place.path));
  TurretDrive result;
  double right_at = 0.0;
  while (drive.time() < place.seconds) {
    drive.step([&](const pipeline::Estimates& estimates, const geometry::Pose2& truth) {
      if (!estimates.rooms) return;
      const geometry::UncertainPose2& pose = estimates.rooms->pose;
      gaze.takePose(estimates.located.scan.stamp, pose);
      const double error = (pose.mean.translation() - truth.translation()).norm();
      result.spread.sigmas += std::sqrt(pose.covariance.topLeftCorner<2, 2>().trace());
      result.spread.errors += error;
      result.spread.scans += 1.0;
      if (error < kShelf) right_at = drive.time();
      result.longest_off = std::max(result.longest_off, drive.time() - right_at);
    });
    const std::int64_t now = drive.simulation().time();
    if (now % 20'000'000 != 0) continue;
    if (const auto command = gaze.decide(now)) drive.carrier().commandTurret(0, *command);
  }
  return result;
}

/// Runs of a hundred in which the plain method takes the shelf for the wall, for more than 2 s.
inline double plainLockIns(gaze::GazeMode mode, std::uint64_t seeds) {
  constexpr double kLongest = 2.0;  // [s]
  double locked_in = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const TurretDrive drive =
        turretDrive(kGazePlaces[0], "jensfelt_living_room", mode, tracking::Method::kPlain, seed);
    locked_in += drive.longest_off > kLongest ? 1.0 : 0.0;
  }
  return 100.0 * locked_in / static_cast<double>(seeds);
}

inline void printPlainLockIns(std::uint64_t seeds) {
  const double ahead = plainLockIns(gaze::GazeMode::kHold, seeds);
  const double inform = plainLockIns(gaze::GazeMode::kInform, seeds);
  print("gaze.turret.plain_locked_in.ahead", ahead, "%");
  print("gaze.turret.plain_locked_in.inform", inform, "%");
  if (ahead > 0.0) print("gaze.turret.plain_locked_in_ratio", inform / ahead, "1");
}

inline void turret(std::uint64_t seeds) {
  for (const GazePlace& place : kGazePlaces) {
    PoseSpread ahead, inform;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      for (auto [mode, sum] : {std::pair{gaze::GazeMode::kHold, &ahead},
                               std::pair{gaze::GazeMode::kInform, &inform}}) {
        const PoseSpread spread =
            turretDrive(place, place.name, mode, tracking::Method::kFull, seed).spread;
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
    const double bound =
        boundOf(place, turretGaze(gaze::GazeMode::kInform), motion::OdometryNoise::unmeasured());
    print(name + "bound_ratio", bound / ahead.sigma(), "1");
  }
  printPlainLockIns(seeds);
}

}  // namespace sightline::bench
