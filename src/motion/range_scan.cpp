#include "sightline/motion/range_scan.h"

#include <algorithm>
#include <utility>

namespace sightline::motion {

using geometry::Pose2;

Pose2 HeadSweep::T_mount_sensor(std::size_t beam) const {
  return Pose2(0.0, 0.0, angles[beam]) * Pose2(origin, 0.0);
}

std::vector<Pose2> headMotion(const HeadSweep& head, const std::vector<Pose2>& mount_motion) {
  const auto turned = [&](double angle) { return angle != head.angles.front(); };
  if (mount_motion.empty() && std::none_of(head.angles.begin(), head.angles.end(), turned)) {
    return {};
  }
  const Pose2 T_first_mount = head.T_mount_sensor(0).inverse();
  std::vector<Pose2> motion;
  motion.reserve(head.angles.size());
  for (std::size_t beam = 0; beam < head.angles.size(); ++beam) {
    const Pose2 moved = mount_motion.empty() ? Pose2() : mount_motion[beam];
    motion.push_back(T_first_mount * moved * head.T_mount_sensor(beam));
  }
  return motion;
}

HeadSweep mirrored(HeadSweep head) {
  for (double& angle : head.angles) angle = -angle;
  head.origin.y() *= -1.0;
  return head;
}

}  // namespace sightline::motion
