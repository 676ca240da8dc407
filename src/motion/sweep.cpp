#include "sightline/motion/sweep.h"

namespace sightline::motion {

std::vector<geometry::Pose2> sweepMotion(const scan::ScanGeometry& geometry,
                                         const geometry::Pose2& T_start_end,
                                         const geometry::Pose2& T_carrier_sensor) {
  const double duration = geometry.timeOffsets().back();
  if (duration == 0.0) return {};
  // Motion of the sensor itself: conjugating the carrier's motion keeps the velocity constant.
  const geometry::Pose2 motion = T_carrier_sensor.inverse() * T_start_end * T_carrier_sensor;
  const Eigen::Vector3d velocity = motion.log() / duration;
  if (velocity.isZero(1e-9)) return {};
  std::vector<geometry::Pose2> poses;
  poses.reserve(geometry.beams());
  for (const double offset : geometry.timeOffsets()) {
    poses.push_back(geometry::Pose2::exp(offset * velocity));
  }
  return poses;
}

}  // namespace sightline::motion
