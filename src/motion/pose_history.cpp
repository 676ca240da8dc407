#include "sightline/motion/pose_history.h"

#include <algorithm>

namespace sightline::motion {

void PoseHistory::add(std::int64_t stamp, const geometry::Pose2& pose) {
  if (!poses_.empty() && stamp < poses_.back().stamp) poses_.clear();
  if (!poses_.empty() && stamp == poses_.back().stamp) poses_.pop_back();
  poses_.push_back({stamp, pose});
  // One pose before the horizon stays, to interpolate across it.
  while (poses_.size() > 2 && poses_[1].stamp < stamp - length_) poses_.pop_front();
}

std::optional<geometry::Pose2> PoseHistory::at(std::int64_t stamp) const {
  if (poses_.empty() || stamp < oldest() || stamp > newest()) return std::nullopt;
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp,
                       [](const StampedPose2& p, std::int64_t time) { return p.stamp < time; });
  if (after->stamp == stamp) return after->pose;
  const StampedPose2& before = *std::prev(after);
  const double ratio =
      static_cast<double>(stamp - before.stamp) / static_cast<double>(after->stamp - before.stamp);
  return geometry::interpolate(before.pose, after->pose, ratio);
}

}  // namespace sightline::motion
