#include "sightline/motion/odometry_noise.h"

#include <cmath>
#include <utility>

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

OdometryNoise OdometryNoise::unmeasured() {
  OdometryNoise noise;
  noise.scale_mean = 1.0;
  noise.scale_sigma = 0.02;
  noise.heading_bias_per_metre = 0.0;
  noise.steering_bias = 0.0;
  noise.distance_sigma = 0.02;
  noise.lateral_sigma = 0.01;
  noise.heading_sigma_per_metre = 0.02;
  noise.steering_sigma = 0.05;
  return noise;
}

geometry::Pose2 expectedStep(const OdometryNoise& noise, const geometry::Pose2& measured,
                             double scale) {
  Eigen::Vector3d tangent = measured.log();
  const double length = tangent.head<2>().norm();
  tangent.head<2>() *= scale;
  tangent[2] += noise.steering_bias * tangent[2] + noise.heading_bias_per_metre * length;
  return geometry::Pose2::exp(tangent);
}

namespace {

// Effect on the end of a path of slips along and across it and of a turn, all at one place of the
// path.
Eigen::Matrix3d effectAt(const geometry::Pose2& place, const geometry::Pose2& end,
                         const Eigen::Vector2d& direction) {
  const Eigen::Vector2d along = place.rotation() * direction;
  const Eigen::Vector2d rest = end.translation() - place.translation();
  Eigen::Matrix3d effect;
  effect << along.x(), -along.y(), -rest.y(), along.y(), along.x(), rest.x(), 0.0, 0.0, 1.0;
  return effect;
}

}  // namespace

Eigen::Matrix3d stepCovariance(const OdometryNoise& noise, const geometry::Pose2& step) {
  const Eigen::Vector3d tangent = step.log();
  const Eigen::Vector2d direction = tangent.head<2>().normalized();
  const double length = tangent.head<2>().norm();
  const double turn = std::abs(tangent[2]);
  const Eigen::Vector3d variances(
      noise.distance_sigma * noise.distance_sigma * length,
      noise.lateral_sigma * noise.lateral_sigma * length,
      noise.heading_sigma_per_metre * noise.heading_sigma_per_metre * length +
          noise.steering_sigma * noise.steering_sigma * turn);
  // The noise is spread evenly over the path. Simpson's rule: exact for a straight one.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& [ratio, weight] : {std::pair(0.0, 1.0), {0.5, 4.0}, {1.0, 1.0}}) {
    const Eigen::Matrix3d effect = effectAt(geometry::Pose2::exp(ratio * tangent), step, direction);
    covariance += weight / 6.0 * effect * variances.asDiagonal() * effect.transpose();
  }
  return covariance;
}

}  // namespace sightline::motion
