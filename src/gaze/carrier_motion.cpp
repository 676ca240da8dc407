#include "sightline/gaze/carrier_motion.h"

#include <algorithm>
#include <cmath>

namespace sightline::gaze {

namespace {

// Time over which the velocity of the carrier is taken [ns].
constexpr std::int64_t kVelocitySpan = 60'000'000;

}  // namespace

void CarrierMotion::add(std::int64_t stamp, const geometry::Pose2& T_odom_base) {
  history_.add(stamp, T_odom_base);
}

bool CarrierMotion::isFresh(std::int64_t now) const {
  return !history_.empty() && now - history_.newest() <= std::llround(1e9 * patience_);
}

std::optional<geometry::Pose2> CarrierMotion::newest() const {
  return history_.empty() ? std::nullopt : history_.at(history_.newest());
}

Eigen::Vector3d CarrierMotion::twist() const {
  if (history_.empty()) return Eigen::Vector3d::Zero();
  const std::int64_t newest = history_.newest();
  const std::int64_t before = std::max(history_.oldest(), newest - kVelocitySpan);
  if (before == newest) return Eigen::Vector3d::Zero();
  return geometry::between(*history_.at(before), *history_.at(newest)).log() /
         (1e-9 * static_cast<double>(newest - before));
}

std::optional<geometry::Pose2> CarrierMotion::at(std::int64_t stamp) const {
  if (history_.empty()) return std::nullopt;
  if (stamp <= history_.newest()) return history_.at(stamp);
  const double ahead = 1e-9 * static_cast<double>(stamp - history_.newest());
  return *history_.at(history_.newest()) *
         geometry::Pose2::exp(std::min(ahead, patience_) * twist());
}

}  // namespace sightline::gaze
