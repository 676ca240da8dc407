#pragma once

#include <map>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <visualization_msgs/MarkerArray.h>

#include "sightline/TrackerStatus.h"
#include "sightline/bridge/output.h"
#include "sightline/bridge/shortfall.h"
#include "sightline/pipeline/estimators.h"
#include "sightline/tracking/wall_report.h"

namespace sightline::bridge {

/// Settings of the output of room poses.
struct RoomOutputConfig {
  bool publish_tf = true;            ///< whether map→odom is broadcast
  double transform_tolerance = 0.0;  ///< the broadcast is dated this much after the scan [s]
  double transform_rate = 0.0;       ///< at which it is sent again between scans [Hz]; 0: not
  void visit(config::FieldVisitor& visitor);
};

/// The pose in the rooms of a map: `pose`, `tracker_status`, map→odom on tf, the map itself,
/// latched, on `map`, and markers. In a running graph, with publish_tf, also the frame of the rooms
/// file, which is that of the map with `_rooms` behind its name: with it tf, and so rviz, knows the
/// frame of the map before there is a pose.
class RoomOutput {
 public:
  RoomOutput(Output& output, const RoomOutputConfig& config, const pipeline::Frames& frames,
             const pipeline::RoomsConfig& rooms, const world::RoomMap& map);

  /// `has_pose` is whether the tracker has been given a pose. Returns why there is none for this
  /// scan; empty where there is one.
  std::string write(const pipeline::Estimates& estimates, bool has_pose);
  /// Draws the rooms and what is awaited, where there was no pose for the last scan, or no scan.
  void drawAwaited();
  /// Sends map→odom of the last scan again, as of this time.
  void resend(const ros::Time& now);
  /// Writes the map anew: it was replaced.
  void renewMap();
  const TrackerStatus& status() const { return status_; }
  double odometryScale() const { return odometry_scale_; }
  EstimatorCount counted() const { return {"rooms", poses_, without_pose_}; }
  /// What became of the scans, and the walls that stand elsewhere than the map says, or do not fit.
  std::vector<std::string> summary() const;
  /// Writes each wall that was seen, how often it corrected the pose and where it was seen to
  /// stand, one a line. Throws config::Error with the path where it cannot be written.
  void writeWalls(const std::string& path) const;

 private:
  void writeMap();
  void writeFrameOfRooms(Output& output);
  void writeTransform(geometry_msgs::TransformStamped T_map_odom);
  void writePose(const pipeline::Estimates& estimates);
  std::vector<std::string> suspectWalls() const;
  std::string writeNone(const pipeline::Estimates& estimates, bool has_pose);

  RoomOutputConfig config_;
  pipeline::Frames frames_;
  const world::RoomMap& map_;
  double map_resolution_;
  double wall_sigma_;
  tracking::WallReport wall_report_;
  Port<geometry_msgs::PoseWithCovarianceStamped> pose_;
  Port<TrackerStatus> status_port_;
  Port<tf2_msgs::TFMessage> transforms_;
  Port<nav_msgs::OccupancyGrid> map_port_;
  Port<visualization_msgs::MarkerArray> markers_;  // only in a running graph
  Port<tf2_msgs::TFMessage> static_transforms_;    // only in a running graph
  TrackerStatus status_;
  geometry_msgs::TransformStamped T_map_odom_;  // that was sent last; no frame where none was
  double odometry_scale_ = 1.0;
  bool map_is_written_ = false;
  bool has_pose_ = false;  // for the last scan
  std::size_t scans_ = 0;
  std::size_t poses_ = 0;
  std::size_t lost_ = 0;
  std::map<std::string, std::size_t> without_pose_;  // by reason
};

}  // namespace sightline::bridge
