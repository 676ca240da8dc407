#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"
#include "sightline/lines/feature_tracker_config.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/motion/floor.h"
#include "sightline/pipeline/feed_config.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/pipeline/targets_config.h"
#include "sightline/tracking/tracker_config.h"

namespace sightline::pipeline {

enum class LineMethod {
  kFull,   ///< lines::LineExtractor
  kPlain,  ///< lines::PlainExtractor
};

/// Settings of the line extractor.
struct LinesConfig {
  LineMethod method = LineMethod::kFull;
  lines::LineExtractorConfig extractor;

  void visit(config::FieldVisitor& visitor);
};

/// Settings of the room tracker.
struct RoomsConfig {
  std::string map;                                ///< path of the rooms file
  std::optional<geometry::Pose2> initial_pose;    ///< T_map_base at the first scan
  std::array<double, 2> initial_sigma{0.3, 0.1};  ///< position, heading [m, rad]
  double map_resolution = 0.05;                   ///< of the occupancy grid [m]
  tracking::TrackerConfig tracker;

  void visit(config::FieldVisitor& visitor);
  /// The start pose with its uncertainty; it has to be there.
  geometry::UncertainPose2 start() const;
};

/// Topics of the scans and the way they are completed: settings that all estimators share.
struct InputConfig {
  std::vector<std::string> scans;        ///< topics of sensor_msgs/LaserScan
  std::vector<std::string> range_scans;  ///< topics of sightline/RangeScan
  std::vector<std::string> echo_scans;   ///< topics of sensor_msgs/MultiEchoLaserScan
  std::string odometry_topic = "odom";
  std::string imu_topic = "imu";
  FeedConfig feed;
  bool leans = false;  ///< whether the scanner does not keep level: it sees floor and ceiling
  motion::FloorConfig floor;  ///< of a scanner that leans

  void visit(config::FieldVisitor& visitor);
  /// All topics of scans: lasers, range scans, echoes; `scan` where none are named.
  std::vector<std::string> topics() const;
  std::vector<std::string> laserTopics() const;
};

/// Settings of all estimators, live and over a recording, and the file that holds them.
///
/// ```yaml
/// scans: [scan]                          # topics of sensor_msgs/LaserScan
/// range_scans: [range_scan]              # topics of sightline/RangeScan
/// echo_scans: [echoes]                   # topics of sensor_msgs/MultiEchoLaserScan
/// noise: {sigma: 0.01}                   # these and more: InputConfig, FeedConfig
/// frames: {map: map, odom: odom, base: base_link}
/// mountings: {laser: [0.2, 0.0, 0.0]}    # x, y, yaw on the base [m, m, rad], by frame, where
///                                        # no transform tells
/// lines: {min_length: 0.5}               # LinesConfig
/// features: {absence: 2.0}               # lines::FeatureTrackerConfig
/// rooms:                                 # RoomsConfig; left out: no room tracker
///   map: rooms.yaml                      # relative to this file
///   initial_pose: [0.0, 0.0, 0.0]        # m, m, rad; without it the map is searched
///   tracker: {neighbours: true}
/// carrier: ../carriers/body_worn.yaml    # settings of leans, floor and odometry
/// odometry: {max_gap: 1.0}               # ScanOdometryConfig; goes before the carrier's file.
///                                        # Without either: no odometry from scans
/// targets: {robots: [robot1, robot2]}    # TargetsConfig; left out: no target tracker
/// ```
struct EstimatorsConfig {
  InputConfig input;
  Frames frames;
  std::map<std::string, geometry::Pose2> mountings;  ///< T_base_sensor by frame
  LinesConfig lines;
  lines::FeatureTrackerConfig features;
  std::optional<RoomsConfig> rooms;
  std::optional<ScanOdometryConfig> odometry;
  std::optional<TargetsConfig> targets;
  std::string carrier;  ///< path of a file with settings that depend on who carries the scanner

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error with file, line and key.
  static EstimatorsConfig readFile(const std::string& path);
};

}  // namespace sightline::pipeline
