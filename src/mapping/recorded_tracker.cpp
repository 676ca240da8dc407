#include "sightline/mapping/recorded_tracker.h"

#include <utility>

namespace sightline::mapping {

std::vector<geometry::StampedPose2> odometryOf(const Survey& survey) {
  std::vector<geometry::StampedPose2> odometry;
  for (const PathPoint& point : survey.path()) {
    odometry.push_back({point.stamp, point.T_odom_base});
  }
  return odometry;
}

pipeline::Estimates RecordedTracker::take(pipeline::LocatedScan located) {
  constexpr std::int64_t kWidestGap = 1'000'000'000;
  if (!located.T_base_sensor) located.T_base_sensor = geometry::Pose2();
  if (!located.T_odom_base) {
    located.T_odom_base = located.T_path_base =
        geometry::poseAt(odometry_.begin(), odometry_.end(), located.scan.stamp, kWidestGap);
  }
  return estimators_.take(std::move(located));
}

}  // namespace sightline::mapping
