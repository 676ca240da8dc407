#pragma once

#include <algorithm>
#include <map>

#include "bench/figures.h"
#include "bench/gaze/features.h"
#include "bench/gaze/rig.h"

namespace sightline::bench {

struct GazePlace {
  const char* name;
  geometry::Pose2 start;
  const char* path;
  double seconds;
};
inline const GazePlace kGazePlaces[] = {
    {"living_room",
     {-3.2, 1.4, 0.0},
     "{speed: 0.3, turn_rate: 0.8, tolerance: 0.2, repeat: true, waypoints: [[0.3, 1.13], "
     "[1.2, -0.5], [3.2, -1.2], [1.2, -1.2], [0, 0], [-1.5, 1.2], [-3.2, 1.4]]}",
     100.0},
    {"corridor",
     {20.0, 0.0, 0.0},
     "{speed: 0.4, turn_rate: 0.8, tolerance: 0.2, repeat: true, waypoints: [[26.3, 0.0], "
     "[20.0, 0.1]]}",
     60.0},
};

/// Certainty that a tracker has, and its error.
struct PoseSpread {
  double sigmas = 0.0;  // sum over scans of the square root of the trace of x and y [m]
  double errors = 0.0;  // sum of the distances from the truth [m]
  double scans = 0.0;
  double sigma() const { return sigmas / scans; }
  double error() const { return errors / scans; }
};

struct GazeWay {
  const char* name;
  gaze::GazeMode mode;
  double angle = 0.0;  // of a head that holds [rad]
};
inline const GazeWay kGazeWays[] = {{"ahead", gaze::GazeMode::kHold, 0.0},
                                    {"left", gaze::GazeMode::kHold, 0.5 * geometry::kPi},
                                    {"right", gaze::GazeMode::kHold, -0.5 * geometry::kPi},
                                    {"sweep", gaze::GazeMode::kSweep},
                                    {"inform", gaze::GazeMode::kInform}};

inline pipeline::EstimatorsConfig trackingConfig(const GazePlace& place) {
  pipeline::EstimatorsConfig config;
  const motion::OdometryNoise wheels = simulation::RobotConfig{}.odometry;
  config.rooms.emplace();
  config.rooms->map = std::string(SIGHTLINE_SOURCE_DIR "/config/rooms/") + place.name + ".yaml";
  config.rooms->initial_pose = place.start;
  config.rooms->initial_sigma = {0.05, 0.02};
  config.rooms->tracker.odometry = wheels;
  config.input.feed.sweep_noise = wheels;
  config.input.feed.head_sigma = geometry::radians(0.36) * std::sqrt(0.25 + 1.0 / 12.0);
  return config;
}

inline PoseSpread spreadOf(const GazePlace& place, const GazeWay& way, std::uint64_t seed) {
  const auto world = world::World::readFile(std::string(SIGHTLINE_SOURCE_DIR "/config/worlds/") +
                                            place.name + ".yaml");
  const auto config = trackingConfig(place);
  test::SimulatedDrive drive(world, simulation::RobotConfig{}, place.start, seed, config,
                             {false, true, false, false});
  gaze::GazeConfig gaze;
  gaze.mode = way.mode;
  gaze.odometry = config.rooms->tracker.odometry;
  GazeRig rig(drive, gaze, seed);
  rig.gaze().setMap(world::RoomMap::readFile(config.rooms->map));
  drive.carrier().follow(pathOf(place.path));
  if (way.mode == gaze::GazeMode::kHold) {
    drive.carrier().commandHead(0, {motion::HeadCommand::Mode::kPosition, way.angle, 0.0});
  }
  PoseSpread spread;
  rig.run(place.seconds, [&](const pipeline::Estimates& estimates, const geometry::Pose2& truth) {
    if (!estimates.rooms) return;
    spread.sigmas += std::sqrt(estimates.rooms->pose.covariance.topLeftCorner<2, 2>().trace());
    spread.errors += (estimates.rooms->pose.mean.translation() - truth.translation()).norm();
    spread.scans += 1.0;
  });
  return spread;
}

/// Certainty of a sensor that looks everywhere at once that its head can turn to, where nothing
/// hides a wall and the scale of the wheels is known: no gaze can do better on this way.
inline double boundOf(const GazePlace& place, gaze::GazeConfig config,
                      const motion::OdometryNoise& wheels) {
  const auto map = world::RoomMap::readFile(std::string(SIGHTLINE_SOURCE_DIR "/config/rooms/") +
                                            place.name + ".yaml");
  const double widening = 1.0 + config.head.upper / config.field.half_width;
  config.field.half_width *= widening;
  config.field.beams = static_cast<int>(config.field.beams * widening);
  const gaze::InformativeGaze everywhere(config);
  simulation::Carrier carrier(simulation::RobotConfig{}, place.start, 1);
  carrier.follow(pathOf(place.path));
  gaze::LookingPlace at;
  at.T_map_base = place.start;
  at.T_base_mount = {0.1, 0.0, 0.0};
  at.uncertainty = {Eigen::Vector3d(0.05 * 0.05, 0.05 * 0.05, 0.02 * 0.02).asDiagonal(),
                    {config.inform.wall_position_sigma, config.inform.wall_direction_sigma}};
  PoseSpread spread;
  while (carrier.time() < std::llround(1e9 * place.seconds)) {
    carrier.move();
    if (carrier.time() % 100'000'000 != 0) continue;
    const geometry::Pose2 T_map_base = carrier.robot().T_map_base();
    at.uncertainty.predict(at.T_map_base, geometry::between(at.T_map_base, T_map_base), wheels);
    at.T_map_base = T_map_base;
    for (const auto& wall : everywhere.looksAt(at, 0.0, map, gaze::WallVisibility(1.0))) {
      at.uncertainty.take(wall, T_map_base.translation(), 1.0);
    }
    spread.sigmas += std::sqrt(at.uncertainty.covariance().topLeftCorner<2, 2>().trace());
    spread.scans += 1.0;
  }
  return spread.sigma();
}

inline void triangulation(std::uint64_t seeds) {
  for (const GazePlace& place : kGazePlaces) {
    double best_sigma = 1e9, best_error = 1e9;
    for (const GazeWay& way : kGazeWays) {
      PoseSpread sum;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PoseSpread spread = spreadOf(place, way, seed);
        sum.sigmas += spread.sigmas;
        sum.errors += spread.errors;
        sum.scans += spread.scans;
      }
      const std::string name =
          std::string("gaze.triangulation.") + place.name + "." + way.name + ".";
      print(name + "sigma", sum.sigma(), "m");
      print(name + "error", sum.error(), "m");
      if (way.mode != gaze::GazeMode::kInform) {
        best_sigma = std::min(best_sigma, sum.sigma());
        best_error = std::min(best_error, sum.error());
        continue;
      }
      print(std::string("gaze.triangulation.") + place.name + ".sigma_ratio",
            sum.sigma() / best_sigma, "1");
      print(std::string("gaze.triangulation.") + place.name + ".error_ratio",
            sum.error() / best_error, "1");
      print(std::string("gaze.triangulation.") + place.name + ".bound_ratio",
            boundOf(place, {}, simulation::RobotConfig{}.odometry) / best_sigma, "1");
    }
  }
}

}  // namespace sightline::bench
