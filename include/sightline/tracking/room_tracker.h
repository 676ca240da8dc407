#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/tracking/plain_tracker.h"
#include "sightline/tracking/rival_tracks.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/tracker_update.h"
#include "sightline/tracking/tracking_context.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Tracks the pose of a robot against the walls of the room it is in (jensfelt section 4):
/// prediction from odometry, a validation gate and a range-weighted Hough transform for each wall,
/// line fits, sequential Kalman updates, change of room at doors. By one of two methods:
/// RivalTracks, which needs no start pose, or PlainTracker, which does.
///
/// Not thread-safe. Estimates stay finite whatever comes in.
class RoomTracker {
 public:
  /// Throws config::Error if the configuration is out of range.
  RoomTracker(const TrackerConfig& config, world::RoomMap map);

  /// Changes settings and keeps the pose; another method starts from it. Throws config::Error if
  /// they are out of range.
  void configure(const TrackerConfig& config);
  /// Starts, or starts again, near a pose; method full searches the map where it is vague. The room
  /// is the one the position lies in, or the nearest.
  void setPose(const geometry::UncertainPose2& T_map_base);
  /// Forgets where the robot is and searches the whole map; false by the method plain, which
  /// cannot.
  bool relocalise();
  /// Adds to the uncertainty by hand [m, rad]: method full an independent error, method plain to
  /// the standard deviation.
  void inflate(double position_sigma, double heading_sigma);
  /// Says which room the robot is in, and adds the uncertainty of a threshold; false if no room has
  /// that name.
  bool setRoom(const std::string& name);

  /// Goes on in another map, with the pose as it is.
  void replaceMap(world::RoomMap map);

  /// Forgets the stamp and the odometry of the last scan but keeps the pose: the clock was set
  /// back.
  void restartClock();

  /// Takes one scan, with the sensor's motion and its noise filled in, and the odometry at its
  /// stamp. Scans of several sensors may come in turn. Nothing before a pose has been given or
  /// claimed, and nothing for a scan older than the last one used.
  std::optional<TrackerUpdate> update(const scan::Scan& scan, const geometry::Pose2& T_odom_base,
                                      const geometry::Pose2& T_base_sensor);

  /// Whether a pose has been given, or found and claimed.
  bool hasPose() const;
  /// All that is held possible: the published pose, then the most probable; nothing by the method
  /// plain.
  std::vector<RivalPose> rivals() const;
  const world::RoomMap& map() const { return context_.map; }

 private:
  void start(const geometry::UncertainPose2& T_map_base, std::size_t room);
  void startAnywhere();
  std::optional<std::pair<geometry::UncertainPose2, std::size_t>> poseAndRoom() const;

  TrackingContext context_;
  std::variant<std::monostate, RivalTracks, PlainTracker> method_;  // none: plain, without a pose
};

}  // namespace sightline::tracking
