#pragma once

#include <cstdint>

#include "sightline/motion/pose_history.h"
#include "sightline/simulation/body.h"
#include "sightline/simulation/path.h"
#include "sightline/simulation/robot.h"

namespace sightline::simulation {

/// Something without sensors that follows a path, such as a person whom robots meet.
class Mover {
 public:
  /// Stands at T_map_start until the path sets off. Its speed and turn rate are those of the path.
  Mover(const Path& path, const geometry::Pose2& T_map_start);

  /// Moves on to `time` [ns], small against the time that the velocity takes to change.
  void moveTo(std::int64_t time);
  /// Pose at a time [ns] of the last ten seconds.
  geometry::Pose2 T_map_body(std::int64_t time) const { return *history_.at(time); }

 private:
  Drive drive_;
  PathFollower follower_;
  std::int64_t departure_;
  std::int64_t time_ = 0;
  motion::PoseHistory history_;
};

}  // namespace sightline::simulation
