#include "sightline/tracking/line_innovation.h"

namespace sightline::tracking {

LineInnovation compareLines(const geometry::Pose2& T_map_base,
                            const geometry::PolarLine& measured_base,
                            const geometry::PolarLine& wall_map) {
  const geometry::Pose2 T_base_map = T_map_base.inverse();
  const geometry::PolarLine predicted = geometry::transform(T_base_map, wall_map);
  const geometry::PolarLine measured = geometry::describedLike(predicted, measured_base);
  LineInnovation result;
  result.value = {measured.rho - predicted.rho, geometry::wrapAngle(measured.phi - predicted.phi)};
  result.noise = measured.covariance;
  result.pose_jacobian =
      geometry::transformJacobianPose(T_base_map, wall_map) * geometry::inverseJacobian(T_map_base);
  result.sense = {measured.rho == measured_base.rho ? 1.0 : -1.0, 1.0};
  return result;
}

}  // namespace sightline::tracking
