#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/tracking/scan_agreement.h"
#include "sightline/tracking/wall_fit.h"

namespace sightline::tracking {

/// Values as in TrackerStatus.msg.
enum class TrackerState : std::uint8_t {
  kInitialising = 0,
  kTracking = 1,
  kDegraded = 2,
  kLost = 3
};

/// Another explanation of what was seen than the pose that is published.
struct RivalPose {
  geometry::UncertainPose2 pose;  ///< T_map_base at the stamp
  std::size_t room = 0;
  double probability = 0.0;  ///< posterior, among the published pose and all its rivals
};

/// Effect of one scan on the pose.
struct TrackerUpdate {
  std::int64_t stamp = 0;         ///< of the scan, ns
  geometry::UncertainPose2 pose;  ///< T_map_base at the stamp
  geometry::Pose2 T_map_odom;     ///< composed with the odometry at the stamp
  double odometry_scale = 1.0;
  double odometry_scale_sigma = 0.0;
  TrackerState state = TrackerState::kInitialising;
  double quality = 0.0;  ///< probability that the pose is right, see TrackerStatus.msg
  bool covariance_valid = false;
  std::string room;
  std::vector<WallUpdate> walls;
  bool is_outside = false;  ///< whether the pose lies out of its room, past any doorway
  bool jumped = false;      ///< whether the pose left the prediction, with few beams to tell of it
  ScanAgreement agreement;  ///< of the scan with what is seen from the pose
  std::vector<RivalPose> rivals;  ///< most probable first
};

}  // namespace sightline::tracking
