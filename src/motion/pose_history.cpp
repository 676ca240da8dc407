#include "sightline/motion/pose_history.h"

#include <limits>

namespace sightline::motion {

void PoseHistory::add(std::int64_t stamp, const geometry::Pose2& pose) {
  if (!poses_.empty() && stamp < poses_.back().stamp) poses_.clear();
  if (!poses_.empty() && stamp == poses_.back().stamp) poses_.pop_back();
  poses_.push_back({stamp, pose});
  // One pose before the horizon stays, to interpolate across it.
  while (poses_.size() > 2 && poses_[1].stamp < stamp - length_) poses_.pop_front();
}

std::optional<geometry::Pose2> PoseHistory::at(std::int64_t stamp) const {
  return geometry::poseAt(poses_.begin(), poses_.end(), stamp,
                          std::numeric_limits<std::int64_t>::max());
}

}  // namespace sightline::motion
