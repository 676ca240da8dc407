#include "sightline/mapping/recorded_tracker.h"

#include <algorithm>
#include <utility>

namespace sightline::mapping {

namespace {

geometry::Pose2 wheelsFromOdometry(const PathPoint& point) {
  return *point.T_wheels_base * point.T_odom_base.inverse();
}

}  // namespace

std::vector<geometry::StampedPose2> odometryOf(const Survey& survey) {
  const auto& path = survey.path();
  const auto first = std::find_if(path.begin(), path.end(), [](const PathPoint& point) {
    return point.T_wheels_base.has_value();
  });
  const geometry::Pose2 T = first == path.end() ? geometry::Pose2() : wheelsFromOdometry(*first);
  std::vector<geometry::StampedPose2> odometry;
  for (const PathPoint& point : path) odometry.push_back({point.stamp, T * point.T_odom_base});
  return odometry;
}

// Goes on by dead reckoning from where the wheels were last.
void RecordedTracker::giveOdometry(pipeline::LocatedScan& located) {
  constexpr std::int64_t kWidestGap = 1'000'000'000;
  const auto reckoned =
      geometry::poseAt(odometry_.begin(), odometry_.end(), located.scan.stamp, kWidestGap);
  if (!reckoned) return;
  if (located.T_odom_base) {
    T_wheels_reckoned_ = *located.T_odom_base * reckoned->inverse();
  } else {
    located.T_odom_base = located.T_path_base = T_wheels_reckoned_ * *reckoned;
  }
}

pipeline::Estimates RecordedTracker::take(pipeline::LocatedScan located) {
  if (!located.T_base_sensor) located.T_base_sensor = geometry::Pose2();
  giveOdometry(located);
  return estimators_.take(std::move(located));
}

}  // namespace sightline::mapping
