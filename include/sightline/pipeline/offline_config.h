#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/scan/noise_model.h"
#include "sightline/tracking/tracker_config.h"

namespace sightline::pipeline {

/// Names of the frames that the estimators speak of.
struct Frames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";

  void visit(config::FieldVisitor& visitor);
};

/// The room tracker over a recording.
struct RoomsConfig {
  std::string map;                              ///< path of the rooms file
  std::vector<double> initial_pose;             ///< x, y, yaw [m, m, rad]
  std::vector<double> initial_sigma{0.3, 0.1};  ///< position, heading [m, rad]
  tracking::TrackerConfig tracker;

  void visit(config::FieldVisitor& visitor);
};

/// What the estimators over a recording are to be set to.
///
/// ```yaml
/// scans: [scan]                                # topics
/// frames: {map: map, odom: odom, base: base_link}
/// mountings: {laser: [0.2, 0.0, 0.0]}          # x, y, yaw of a scanner's frame on the base,
///                                              # m, m, rad, where the recording does not tell
/// noise: {sigma: 0.01}                         # as scan::NoiseModel
/// lines: {min_length: 0.5}                     # as lines::LineExtractorConfig
/// rooms:                                       # where the room tracker is wanted
///   map: rooms.yaml                            # relative to this file
///   initial_pose: [0.0, 0.0, 0.0]              # m, m, rad
///   tracker: {neighbours: true}                # as tracking::TrackerConfig
/// carrier: ../carriers/body_worn.yaml          # where odometry from scans is wanted, by this
/// odometry: {max_gap: 1.0}                     # or by this, as ScanOdometryConfig; it goes before
///                                              # what the carrier's file says
/// ```
struct OfflineConfig {
  std::vector<std::string> scans{"scan"};
  Frames frames;
  std::map<std::string, geometry::Pose2> mountings;  ///< by frame
  scan::NoiseModel noise;
  lines::LineExtractorConfig lines;
  std::optional<RoomsConfig> rooms;
  std::optional<ScanOdometryConfig> odometry;

  /// Throws config::Error with file, line and key.
  static OfflineConfig readFile(const std::string& path);
};

}  // namespace sightline::pipeline
