#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/motion/pose_history.h"
#include "sightline/scan/scan.h"
#include "sightline/simulation/simulation.h"

namespace sightline::bench {

/// What a simulated robot measured on its way, for many runs of estimators.
struct RecordedDrive {
  struct Sweep {
    scan::Scan scan;
    std::int64_t arrival = 0;  // [ns]
  };
  std::vector<Sweep> sweeps;
  std::vector<geometry::StampedPose2> odometry;                             // T_odom_base at 50 Hz
  motion::PoseHistory truth{std::numeric_limits<std::int64_t>::max() / 2};  // T_map_base
};

struct DriveSetup {
  world::World world;
  geometry::Pose2 start;
  simulation::Path path;
  simulation::ScannerProfile scanner;
  geometry::Pose2 T_base_sensor;
  double height = 0.0;  // of the scanner [m]
  simulation::RobotConfig robot;
  double begin = 0.0;    // time at its start [s]
  double seconds = 0.0;  // that it takes
};

inline RecordedDrive recordDrive(const DriveSetup& setup, std::uint64_t seed) {
  simulation::Simulation simulation(setup.world, setup.robot, setup.start, seed);
  simulation::Mounting mounting;
  mounting.x = setup.T_base_sensor.x();
  mounting.z = setup.height;
  simulation.carrier().addScanner(setup.scanner, mounting);
  simulation.carrier().follow(setup.path);
  const auto begin = static_cast<std::int64_t>(setup.begin * 1e9);
  RecordedDrive drive;
  while (simulation.time() < static_cast<std::int64_t>(setup.seconds * 1e9)) {
    simulation::Outputs outputs = simulation.step();
    drive.truth.add(begin + simulation.time(), simulation.robot().T_map_base());
    for (const simulation::ReportedState& state : outputs.states) {
      drive.odometry.push_back({begin + state.stamp, state.pose.mean});
    }
    for (simulation::FinishedSweep& sweep : outputs.sweeps) {
      sweep.scan.stamp += begin;
      drive.sweeps.push_back({std::move(sweep.scan), begin + simulation.time()});
    }
  }
  return drive;
}

}  // namespace sightline::bench
