#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sightline/geometry/angle.h"
#include "sightline/logs/trajectory.h"

namespace sightline::bridge {

/// Recording of a robot that was tracked while its true pose was known.
struct RecordedRun {
  std::vector<std::int64_t> scans;  ///< stamps [ns], in order
  logs::Trajectory poses;           ///< T_map_base as tracked
  logs::Trajectory truth;           ///< T_map_base
  std::vector<std::string> rooms;   ///< that the robot was held to be in, in order
  std::size_t line_arrays = 0;      ///< messages of line_extractor
  std::size_t walls = 0;            ///< that updated the pose, over all scans
  std::size_t beams = 0;            ///< that these walls were fitted to
};

/// Reads the topics scan, pose, ground_truth, tracker_status and lines. Throws config::Error where
/// the file is no bag or misses one of the first three.
RecordedRun readRun(const std::string& bag);

/// Largest errors of a pose that are accepted.
struct PoseBounds {
  double position = 0.15;                   ///< [m]
  double heading = geometry::radians(3.0);  ///< [rad]
};

/// The error of one pose.
struct PoseError {
  std::int64_t stamp = 0;  ///< [ns]
  double position = 0.0;   ///< [m]
  double heading = 0.0;    ///< [rad], not negative
};

/// Accuracy and completeness of a tracked run.
struct RunReport {
  std::size_t scans_before = 0;   ///< the first pose
  std::size_t scans_after = 0;    ///< the last pose
  std::size_t scans_between = 0;  ///< that have no pose
  double seconds_before = 0.0;    ///< from the first scan to the first pose
  double seconds_after = 0.0;     ///< from the last pose to the last scan
  std::size_t poses_without_truth = 0;
  std::vector<PoseError> errors;  ///< of the poses that have a truth at their stamp

  /// Whether there is a pose for every scan, but for a moment at the start and at the end, and
  /// every pose is within the bounds.
  bool isGood(const PoseBounds& bounds) const;
};

RunReport judge(const RecordedRun& run);

/// A table for people.
std::string describe(const RecordedRun& run, const RunReport& report);

}  // namespace sightline::bridge
