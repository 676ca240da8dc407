#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/tracking/wall_fit.h"

namespace sightline::tracking {

/// Values as in TrackerStatus.msg.
enum class TrackerState : std::uint8_t {
  kInitialising = 0,
  kTracking = 1,
  kDegraded = 2,
  kLost = 3
};

/// Effect of one scan on the pose.
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
  std::vector<WallUpdate> walls;
};

}  // namespace sightline::tracking
