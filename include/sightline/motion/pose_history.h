#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "sightline/geometry/stamped_pose2.h"

namespace sightline::motion {

/// Poses in the order of their stamps, read at any time between them by constant body velocity.
class PoseHistory {
 public:
  /// Keeps poses this long behind the newest [ns].
  explicit PoseHistory(std::int64_t length = 10'000'000'000) : length_(length) {}

  /// A pose before the newest stamp starts the history anew: the clock was set back. One at the
  /// newest stamp takes its place.
  void add(std::int64_t stamp, const geometry::Pose2& pose);
  void clear() { poses_.clear(); }
  bool empty() const { return poses_.empty(); }
  std::int64_t oldest() const { return poses_.front().stamp; }
  std::int64_t newest() const { return poses_.back().stamp; }

  /// Pose at a time; nothing outside [oldest, newest].
  std::optional<geometry::Pose2> at(std::int64_t stamp) const;

 private:
  std::int64_t length_;
  std::deque<geometry::StampedPose2> poses_;
};

}  // namespace sightline::motion
