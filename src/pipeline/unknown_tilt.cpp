#include "sightline/pipeline/unknown_tilt.h"

#include <algorithm>

namespace sightline::pipeline {

namespace {

constexpr double kUsualShare = 0.4;  // of the largest tilt

// Means over the valid beams [m].
struct MeanReturn {
  double range = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // seen from the sensor
};

MeanReturn meanReturn(const scan::Scan& scan) {
  MeanReturn mean;
  double valid = 0.0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double range = scan.ranges()[i];
    mean.range += range;
    mean.position +=
        range * Eigen::Vector2d(scan.geometry()->cosines()[i], scan.geometry()->sines()[i]);
    valid += 1.0;
  }
  mean.range /= std::max(1.0, valid);
  mean.position /= std::max(1.0, valid);
  return mean;
}

// Covariance of the pose, along the axes of the base.
Eigen::Matrix3d tiltCovariance(double tilt, const MeanReturn& mean,
                               const geometry::Pose2& T_base_sensor) {
  const double stretch = 0.5 * tilt * tilt;
  const double along = stretch * mean.range;
  const double across = stretch * mean.position.y();
  const double turn = 0.5 * stretch;
  Eigen::Matrix3d R_base_sensor = Eigen::Matrix3d::Identity();
  R_base_sensor.topLeftCorner<2, 2>() = T_base_sensor.rotation();
  const Eigen::Vector3d variances(along * along, across * across, turn * turn);
  return R_base_sensor * variances.asDiagonal() * R_base_sensor.transpose();
}

}  // namespace

void addUnknownTilt(double max_tilt, const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                    double elapsed, dead_reckoning::DeadReckoningUpdate& update) {
  const Eigen::Matrix3d covariance =
      tiltCovariance(kUsualShare * max_tilt, meanReturn(scan), T_base_sensor);
  Eigen::Matrix3d R_odom_base = Eigen::Matrix3d::Identity();
  R_odom_base.topLeftCorner<2, 2>() = update.pose.mean.rotation();
  update.pose.covariance += R_odom_base * covariance * R_odom_base.transpose();
  if (elapsed <= 0.0) return;
  update.step.covariance += 2.0 * covariance;
  update.twist.covariance += 2.0 / (elapsed * elapsed) * covariance;
}

}  // namespace sightline::pipeline
