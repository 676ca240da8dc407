#include "sightline/tracking/beam_points.h"

namespace sightline::tracking {

Sweep readSweep(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                const motion::OdometryNoise& odometry, double point_sigma) {
  const Eigen::Matrix2d rotation = T_base_sensor.rotation();
  const Eigen::Matrix2d isotropic = point_sigma * point_sigma * Eigen::Matrix2d::Identity();
  const bool moved = !scan.sensorMotion().empty();
  const std::vector<double>& offsets = scan.geometry()->timeOffsets();
  Sweep sweep;
  if (moved) {
    const geometry::Pose2 motion =
        T_base_sensor * scan.sensorMotion().back() * T_base_sensor.inverse();
    sweep.motion_covariance = motion::stepCovariance(odometry, motion);
  }
  sweep.points.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    BeamPoint point;
    point.beam = i;
    point.position = rotation * scan.point(i) + T_base_sensor.translation();
    point.origin =
        moved ? T_base_sensor * scan.sensorMotion()[i].translation() : T_base_sensor.translation();
    point.range = scan.ranges()[i];
    point.covariance = isotropic;
    if (point_sigma <= 0.0) {
      point.covariance = rotation * scan.covariance(i) * rotation.transpose();
    }
    point.sweep_share = moved ? offsets[i] / offsets.back() : 0.0;
    sweep.points.push_back(point);
  }
  return sweep;
}

}  // namespace sightline::tracking
