#pragma once

#include <cstdint>
#include <optional>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/tracking/scan_agreement.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/tracker_update.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Data that all hypotheses of a tracker share.
struct TrackingContext {
  TrackerConfig config;
  world::RoomMap map;
};

/// A scan and where it was taken. Holds the scan by reference.
struct TrackerInput {
  const scan::Scan& scan;         ///< with the sensor's motion and its noise filled in
  geometry::Pose2 T_odom_base;    ///< at the stamp of the scan
  geometry::Pose2 T_base_sensor;  ///< at the stamp of the scan
};

/// State of a hypothesis besides its pose: room, last scan, and the agreement of the last scans.
class TrackMemory {
 public:
  explicit TrackMemory(std::size_t room) : room_(room) {}

  std::size_t room() const { return room_; }
  void setRoom(std::size_t room) { room_ = room; }

  bool isOlder(const TrackerInput& input) const { return input.scan.stamp < stamp_; }
  /// The step of odometry since the last scan, in the body frame at its start; nothing for the
  /// first scan. Remembers the scan.
  std::optional<geometry::Pose2> step(const TrackerInput& input);
  /// Forgets stamp and odometry of the last scan.
  void restartClock();

  /// Begins the report of a scan that left the robot at this pose: all but odometry scale, walls
  /// and whether the covariance is valid. Counts scans in a row that do not agree with the room.
  TrackerUpdate report(const TrackingContext& context, const TrackerInput& input,
                       const geometry::UncertainPose2& pose, const ScanAgreement& agreement);
  /// Goes on into the room that a position lies in, if a door leads there. Whether the robot passed
  /// a threshold.
  bool changeRoom(const world::RoomMap& map, const Eigen::Vector2d& position_map);

 private:
  TrackerState judge(const TrackingContext& context, const TrackerUpdate& update);

  std::size_t room_;
  std::optional<geometry::Pose2> T_odom_base_;  // at the last scan
  std::int64_t stamp_ = 0;                      // of the last scan
  int disagreeing_scans_ = 0;                   // scans in a row that did not agree
};

/// Agreement of a scan with what is seen from a pose in a room.
ScanAgreement agreementAt(const TrackingContext& context, const TrackerInput& input,
                          const geometry::Pose2& T_map_base, std::size_t room,
                          world::RoomView::Doors doors);

/// Whether a covariance of the pose is too large for tracking to be called anything but degraded.
bool isVague(const TrackerConfig& config, const Eigen::Matrix3d& covariance);

/// Fewer beams than this say nothing about whether the room fits.
constexpr std::size_t kLeastEvidence = 20;

}  // namespace sightline::tracking
