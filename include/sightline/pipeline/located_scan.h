#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/floor.h"
#include "sightline/scan/elapsed_time.h"
#include "sightline/scan/learned_noise.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// A scan with all that is known of how it was taken; a member that is absent is not known.
struct LocatedScan {
  std::size_t scanner = 0;  ///< in the order in which scanners were added
  /// The scan as a level sensor the right way up sees it, with the sensor's motion within the sweep
  /// where that is known.
  scan::Scan scan;
  bool upside_down = false;   ///< whether the sensor hangs so, and the scan was mirrored
  bool motion_known = false;  ///< within the sweep
  std::optional<scan::RangeNoise> noise;  ///< of the scanner, where it was learned
  /// Time since the scanner's scan before, where its stamps do not tell it (ScanClock).
  std::optional<scan::ElapsedTime> elapsed;
  /// Mounting at the stamp, which is the first beam of a turning sensor.
  std::optional<geometry::Pose2> T_base_sensor;
  std::optional<geometry::Pose2> T_odom_base;  ///< by wheels, at the stamp
  /// The same in a frame of its own, in which the breaks of the odometry are bridged.
  std::optional<geometry::Pose2> T_path_base;
  bool odometry_broke = false;  ///< since the scan before, of whichever scanner: reset, or leaped
  /// Whether the turns of this scanner's scans are opposite to the odometry's (TurnSense).
  bool turns_opposite = false;
  std::string
      no_odometry;  ///< why T_base_sensor or T_odom_base are not known; empty where both are
  bool before_odometry =
      false;  ///< whether that is since the scan is from before the odometry began
  /// Turn by a gyroscope since the scan before, of whichever scanner [rad].
  std::optional<double> turn;
  std::optional<motion::SweepAttitude> attitude;  ///< of the sensor, by an inertial sensor
  /// The clock was set before this scan: its stamp says nothing of the time since the one before.
  bool clock_restarted = false;
};

}  // namespace sightline::pipeline
