#include "sightline/tracking/beam_points.h"

namespace sightline::tracking {

std::vector<BeamPoint> beamPoints(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                                  double point_sigma) {
  const Eigen::Matrix2d rotation = T_base_sensor.rotation();
  const Eigen::Matrix2d isotropic = point_sigma * point_sigma * Eigen::Matrix2d::Identity();
  std::vector<BeamPoint> points;
  points.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const Eigen::Vector2d origin = scan.sensor_motion.empty()
                                       ? T_base_sensor.translation()
                                       : T_base_sensor * scan.sensor_motion[i].translation();
    const Eigen::Matrix2d covariance =
        point_sigma > 0.0 ? isotropic : Eigen::Matrix2d(rotation * scan.covariance(i) * rotation.transpose());
    points.push_back({i, rotation * scan.point(i) + T_base_sensor.translation(), origin,
                      scan.ranges[i], covariance});
  }
  return points;
}

}  // namespace sightline::tracking
