#include "sightline/motion/sweep_noise.h"

#include <Eigen/LU>

namespace sightline::motion {

using geometry::Pose2;

Eigen::Matrix3d coordinatesByStartTwist(const Pose2& motion) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian.topRightCorner<2, 1>() << -motion.y(), motion.x();
  return jacobian;
}

scan::MotionNoise sweepNoise(const OdometryNoise& noise, const Pose2& T_start_end_base,
                             const Pose2& T_base_sensor) {
  const Pose2 T_sensor_base = T_base_sensor.inverse();
  const Pose2 motion_sensor = T_sensor_base * T_start_end_base * T_base_sensor;
  const Eigen::Matrix3d to_sensor = coordinatesByStartTwist(motion_sensor) *
                                    T_sensor_base.adjoint() *
                                    coordinatesByStartTwist(T_start_end_base).inverse();
  scan::MotionNoise result;
  result.walk = to_sensor * stepCovariance(noise, T_start_end_base) * to_sensor.transpose();
  return result;
}

}  // namespace sightline::motion
