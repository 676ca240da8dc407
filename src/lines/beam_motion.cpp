#include "sightline/lines/beam_motion.h"

#include <algorithm>

namespace sightline::lines {

double timeRatio(const scan::Scan& scan, std::size_t beam) {
  const double duration = scan.duration();
  return duration > 0.0 ? std::max(0.0, scan.geometry()->timeOffsets()[beam]) / duration : 0.0;
}

Eigen::Matrix3d covarianceAfter(double time_ratio, const scan::MotionNoise& noise) {
  return time_ratio * time_ratio * noise.drift + time_ratio * noise.walk;
}

Eigen::Matrix3d motionCovariance(const scan::Scan& scan, std::size_t beam) {
  return covarianceAfter(timeRatio(scan, beam), scan.motion_noise);
}

Eigen::Matrix<double, 2, 3> motionJacobian(const scan::Scan& scan, std::size_t beam,
                                           const Eigen::Vector2d& point) {
  const bool moved = !scan.sensorMotion().empty();
  const Eigen::Vector2d arm =
      moved ? Eigen::Vector2d(point - scan.sensorMotion()[beam].translation()) : point;
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return jacobian;
}

}  // namespace sightline::lines
