#include "sightline/logs/odometry_check.h"

#include <algorithm>
#include <cmath>

namespace sightline::logs {

namespace {

constexpr double kWorldEnd = 1e6;  // [m]
// A step that is faster than this, and by more than what late stamps explain, is a jump.
constexpr double kFastest = 6.0;    // [m/s] and [rad/s]
constexpr double kAllowance = 0.3;  // [m] and [rad]

bool isBelievable(const geometry::Pose2& pose) {
  const bool is_finite = pose.translation().allFinite() && std::isfinite(pose.theta());
  return is_finite && pose.translation().norm() < kWorldEnd;
}

}  // namespace

void OdometryCheck::add(std::int64_t stamp, const geometry::Pose2& pose) {
  ++summary_.poses;
  if (!isBelievable(pose)) {
    ++summary_.refused;
    return;
  }
  if (poses_.empty()) return poses_.push_back({stamp, pose});
  const double elapsed = 1e-9 * static_cast<double>(stamp - poses_.back().stamp);
  if (elapsed <= 0.0) return;
  const geometry::Pose2 step = poses_.back().pose.inverse() * pose;
  const double distance = step.translation().norm();
  const double turn = std::abs(step.theta());
  poses_.push_back({stamp, pose});
  if (std::max(distance, turn) > kFastest * elapsed + kAllowance) {
    ++summary_.jumps;
    if (!summary_.first_jump) summary_.first_jump = stamp;
    return;
  }
  summary_.distance += distance;
  summary_.turned += turn;
}

}  // namespace sightline::logs
