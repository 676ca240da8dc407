#pragma once

#include <string>
#include <vector>

#include "nodes/sim_sensor_config.h"
#include "sightline/config/node.h"

namespace sightline::nodes {

/// A robot of sim_sensor with its sensors.
struct SimRobotSetup {
  std::string name;  ///< namespace of its topics, and prefix of its frames; empty: none
  SimRobotConfig config;
  std::vector<SimScannerConfig> scanners;
  std::vector<SimActiveSensorConfig> active_sensors;
};

/// Everything that sim_sensor simulates. Without `robots` there is one, whose parameters stand
/// beside `world`.
///
/// ```yaml
/// robots:
///   ann: {start_pose: [0, 0, 0], scanners: {laser: {z: 0.4}}}
///   bob: {start_pose: [2, 0, 0], path: FILE, active_sensors: {head: {z: 0.4}}}
/// movers:                              # what else moves
///   person: {path: FILE, radius: 0.2, top: 1.75}
/// ```
/// A robot without `scanners` and `active_sensors` has one scanner. Topics of ann begin with
/// `ann/`, and so do its frames, whatever they are called in its parameters.
struct SimSetup {
  SimSensorConfig node;
  std::vector<SimRobotSetup> robots;
  std::vector<SimMoverConfig> movers;

  /// Frames come with their prefixes. Throws config::Error: also where two sensors have a topic, a
  /// frame or, on one robot, a joint of the same name.
  static SimSetup read(const config::Node& parameters);
};

}  // namespace sightline::nodes
