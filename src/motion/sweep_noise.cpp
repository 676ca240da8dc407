#include "sightline/motion/sweep_noise.h"

namespace sightline::motion {

scan::MotionNoise sweepNoise(const OdometryNoise& noise, const geometry::Pose2& T_start_end_base,
                             const geometry::Pose2& T_base_sensor) {
  const Eigen::Matrix3d of_base = stepCovariance(noise, T_start_end_base);
  const Eigen::Matrix3d to_sensor = T_base_sensor.inverse().adjoint();
  scan::MotionNoise result;
  result.drift = to_sensor * of_base * to_sensor.transpose();
  return result;
}

}  // namespace sightline::motion
