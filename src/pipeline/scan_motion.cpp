#include "sightline/pipeline/scan_motion.h"

#include <cmath>

#include "sightline/motion/sweep.h"

namespace sightline::pipeline {

std::optional<geometry::Pose2> addMotion(scan::Scan& scan, const OdometryAt& odometry,
                                         const geometry::Pose2& T_base_sensor) {
  const auto start = odometry(scan.stamp);
  const double duration = scan.geometry()->timeOffsets().back();
  const auto end = odometry(scan.stamp + std::llround(duration * 1e9));
  if (!start || !end) return std::nullopt;
  scan.setSensorMotion(
      motion::sweepMotion(*scan.geometry(), geometry::between(*start, *end), T_base_sensor));
  return start;
}

}  // namespace sightline::pipeline
