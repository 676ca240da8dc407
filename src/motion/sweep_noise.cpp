#include "sightline/motion/sweep_noise.h"

#include <cmath>

#include <Eigen/LU>

#include "sightline/motion/sensor_path.h"

namespace sightline::motion {

using geometry::Pose2;

Eigen::Matrix3d coordinatesByStartTwist(const Pose2& motion) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian.topRightCorner<2, 1>() << -motion.y(), motion.x();
  return jacobian;
}

scan::MotionNoise sweepNoise(const OdometryNoise& noise, const Pose2& T_start_end_base,
                             const Pose2& T_base_sensor, double duration) {
  const Pose2 T_sensor_base = T_base_sensor.inverse();
  const Pose2 motion_sensor = T_sensor_base * T_start_end_base * T_base_sensor;
  const Eigen::Matrix3d to_sensor = coordinatesByStartTwist(motion_sensor) *
                                    T_sensor_base.adjoint() *
                                    coordinatesByStartTwist(T_start_end_base).inverse();
  const Eigen::Matrix3d covariance =
      to_sensor * stepCovariance(noise, T_start_end_base) * to_sensor.transpose();
  const double of_drift = std::abs(duration) > kStretch ? kStretch / std::abs(duration) : 1.0;
  scan::MotionNoise result;
  result.drift = of_drift * covariance;
  result.walk = (1.0 - of_drift) * covariance;
  return result;
}

}  // namespace sightline::motion
