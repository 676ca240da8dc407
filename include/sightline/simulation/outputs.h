#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sightline/geometry/attitude.h"
#include "sightline/geometry/pose2.h"
#include "sightline/geometry/twist2.h"
#include "sightline/motion/range_scan.h"
#include "sightline/scan/scan.h"
#include "sightline/simulation/robot.h"

namespace sightline::simulation {

/// A sweep that has just ended. Robots and sensors count in the order in which they were added.
struct FinishedSweep {
  std::size_t robot = 0;
  std::size_t scanner = 0;
  scan::Scan scan;
};

/// A scan of an active sensor that has just ended.
struct FinishedRangeScan {
  std::size_t robot = 0;
  std::size_t sensor = 0;
  motion::RangeScan range_scan;
};

/// Report of the head of an active sensor, as of its last sample, or of the turret of a scanner.
struct ReportedHead {
  std::size_t robot = 0;
  std::size_t sensor = 0;  ///< the active sensor, or the scanner on the turret
  std::int64_t stamp = 0;  ///< [ns]
  double angle = 0.0;      ///< of its joint [rad]
  double rate = 0.0;       ///< [rad/s]
};

/// Report of the wheels, and the truth.
struct ReportedState {
  std::size_t robot = 0;
  std::int64_t stamp = 0;           ///< [ns]
  geometry::UncertainPose2 pose;    ///< T_odom_base
  geometry::UncertainTwist2 twist;  ///< mean since the last report
  geometry::Pose2 T_map_base;       ///< true pose
  Velocity velocity;                ///< true velocity
};

/// Reading of a perfect inertial sensor that sits straight on the base.
struct ReportedMotion {
  std::size_t robot = 0;
  std::int64_t stamp = 0;       ///< [ns]
  geometry::Attitude attitude;  ///< of the base
  double turn_rate = 0.0;       ///< of its heading, mean over the step [rad/s]
};

/// Everything that was measured within a step, by robot, sensor and time.
struct Outputs {
  std::vector<FinishedSweep> sweeps;
  std::vector<FinishedRangeScan> range_scans;
  std::vector<ReportedHead> heads;      ///< one a step and active sensor
  std::vector<ReportedHead> turrets;    ///< one a step and commanded turret
  std::vector<ReportedState> states;    ///< at the rate of each robot's odometry
  std::vector<ReportedMotion> motions;  ///< one a step and robot
};

}  // namespace sightline::simulation
