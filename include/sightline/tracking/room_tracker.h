#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/wall_observation.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Values as in TrackerStatus.msg.
enum class TrackerState : std::uint8_t {
  kInitialising = 0,
  kTracking = 1,
  kDegraded = 2,
  kLost = 3
};

/// What one scan did to the pose.
struct TrackerUpdate {
  std::int64_t stamp = 0;         ///< of the scan, ns
  geometry::UncertainPose2 pose;  ///< T_map_base at the stamp
  geometry::Pose2 T_map_odom;     ///< composed with the odometry at the stamp
  double odometry_scale = 1.0;
  double odometry_scale_sigma = 0.0;
  TrackerState state = TrackerState::kInitialising;
  double quality = 0.0;  ///< [0, 1], see TrackerStatus.msg
  bool covariance_valid = false;
  std::string room;
  std::vector<WallObservation> walls;
};

/// Tracks the pose of a robot against the walls of the room it is in (jensfelt section 4):
/// prediction from odometry, a validation gate and a range-weighted Hough transform for each wall,
/// line fits, sequential Kalman updates, change of room at doors.
///
/// Not thread-safe. Estimates stay finite whatever comes in.
class RoomTracker {
 public:
  /// Throws config::Error if the configuration is out of range.
  RoomTracker(const TrackerConfig& config, world::RoomMap map);
  ~RoomTracker();
  RoomTracker(RoomTracker&&) noexcept;
  RoomTracker& operator=(RoomTracker&&) noexcept;

  /// Changes settings and keeps the pose. Throws config::Error if they are out of range.
  void configure(const TrackerConfig& config);
  /// Starts, or starts again, at a pose. The room is the one the position lies in, or the nearest.
  void setPose(const geometry::UncertainPose2& T_map_base);
  /// Adds to the uncertainty by hand [m, rad].
  void inflate(double position_sigma, double heading_sigma);
  /// Says which room the robot is in; false if no room has that name.
  bool setRoom(const std::string& name);

  /// Forgets the stamp and the odometry of the last scan but keeps the pose: the clock was set
  /// back.
  void restartClock();

  /// Takes one scan, with the sensor's motion filled in, and the odometry at its stamp. Scans of
  /// several sensors may come in turn. Nothing before the first pose, and nothing for a scan older
  /// than the last one used.
  std::optional<TrackerUpdate> update(const scan::Scan& scan, const geometry::Pose2& T_odom_base,
                                      const geometry::Pose2& T_base_sensor);

  /// Whether it has been given a pose.
  bool hasPose() const;
  const world::RoomMap& map() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sightline::tracking
