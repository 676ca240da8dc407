#include "sightline/motion/odometry_noise.h"

#include <cmath>

namespace sightline::motion {

void OdometryNoise::visit(config::FieldVisitor& visitor) {
  const config::Range share{0.0, 1.0};
  visitor.number("scale_mean", scale_mean,
                 {"1", {0.5, 2.0}, "true length over measured length (jensfelt appendix)"});
  visitor.number("scale_sigma", scale_sigma,
                 {"1", share, "standard deviation of the scale over runs (jensfelt appendix)"});
  visitor.number(
      "distance_sigma", distance_sigma,
      {"m/sqrt(m)", share, "white error of the length after one metre (jensfelt section 4.1)"});
  visitor.number("lateral_sigma", lateral_sigma,
                 {"m/sqrt(m)", share, "sideways slip after one metre"});
  visitor.number("heading_bias_per_metre", heading_bias_per_metre,
                 {"rad/m", {-1.0, 1.0}, "turn not reported, per metre driven (jensfelt appendix)"});
  visitor.number(
      "heading_sigma_per_metre", heading_sigma_per_metre,
      {"rad/sqrt(m)", share, "spread of the heading after one metre (jensfelt section 4.1)"});
  visitor.number("steering_bias", steering_bias,
                 {"1", {-1.0, 1.0}, "turn not reported, share of the turn (jensfelt appendix)"});
  visitor.number("steering_sigma", steering_sigma,
                 {"rad/sqrt(rad)", share,
                  "spread of the heading after one radian of turn (jensfelt section 4.1)"});
}

geometry::Pose2 expectedStep(const OdometryNoise& noise, const geometry::Pose2& measured,
                             double scale) {
  const double length = measured.translation().norm();
  const double turn =
      (1.0 + noise.steering_bias) * measured.theta() + noise.heading_bias_per_metre * length;
  return {scale * measured.translation(), turn};
}

Eigen::Matrix3d stepCovariance(const OdometryNoise& noise, const geometry::Pose2& step) {
  const double length = step.translation().norm();
  const double turn = std::abs(step.theta());
  const double along = noise.distance_sigma * noise.distance_sigma * length;
  const double across = noise.lateral_sigma * noise.lateral_sigma * length;
  const double heading = noise.heading_sigma_per_metre * noise.heading_sigma_per_metre * length +
                         noise.steering_sigma * noise.steering_sigma * turn;
  Eigen::Matrix3d covariance = Eigen::Vector3d(along, across, heading).asDiagonal();
  // The heading error builds up along the step: the end point shares it with half the length as its
  // lever.
  const Eigen::Vector3d lever(-0.5 * step.y(), 0.5 * step.x(), 0.0);
  covariance += heading * lever * lever.transpose();
  covariance.col(2) += heading * lever;
  covariance.row(2) += heading * lever.transpose();
  return covariance;
}

}  // namespace sightline::motion
