#pragma once

#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/survey.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::mapping {

/// The poses of a survey by dead reckoning, T_odom_base, in the frame of the wheels as of the first
/// scan that has any.
std::vector<geometry::StampedPose2> odometryOf(const Survey& survey);

/// The room tracker over a recording, with odometry where it brings none.
class RecordedTracker {
 public:
  /// Throws config::Error.
  ///
  /// @param config    its `rooms` say the map
  /// @param odometry  for scans without, as by dead reckoning
  RecordedTracker(const pipeline::EstimatorsConfig& config,
                  std::vector<geometry::StampedPose2> odometry)
      : odometry_(std::move(odometry)), estimators_(config, {false, true, false}) {}

  /// Nothing where the tracker has no pose.
  pipeline::Estimates take(pipeline::LocatedScan located);

  const world::RoomMap& map() { return estimators_.rooms()->map(); }

 private:
  void giveOdometry(pipeline::LocatedScan& located);

  std::vector<geometry::StampedPose2> odometry_;
  geometry::Pose2 T_wheels_reckoned_;
  pipeline::Estimators estimators_;
};

}  // namespace sightline::mapping
