#include "sightline/bridge/odometry_check.h"

#include <cmath>

namespace sightline::bridge {

void OdometryCheck::add(std::int64_t stamp, const geometry::Pose2& pose) {
  const bool is_first = poses_.empty();
  if (!is_first && stamp <= poses_.back().stamp) return;
  ++summary_.poses;
  const geometry::StampedPose2 before =
      is_first ? geometry::StampedPose2{stamp, pose} : poses_.back();
  poses_.push_back({stamp, pose});
  const geometry::Pose2 step = geometry::between(before.pose, pose);
  if (!limits_.allow(step, 1e-9 * static_cast<double>(stamp - before.stamp))) {
    ++summary_.jumps;
    if (!summary_.first_jump) summary_.first_jump = stamp;
    return;
  }
  summary_.distance += step.translation().norm();
  summary_.turned += std::abs(step.theta());
}

}  // namespace sightline::bridge
