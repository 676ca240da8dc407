#include "sightline/pipeline/wheel_prior.h"

namespace sightline::pipeline {

using dead_reckoning::MotionPrior;
using geometry::Pose2;

motion::OdometryNoise WheelsConfig::unmeasured() {
  motion::OdometryNoise noise;
  noise.scale_mean = 1.0;
  noise.scale_sigma = 0.03;
  noise.distance_sigma = 0.03;
  noise.lateral_sigma = 0.02;
  noise.heading_bias_per_metre = 0.0;
  noise.heading_sigma_per_metre = 0.05;
  noise.steering_bias = 0.0;
  noise.steering_sigma = 0.1;
  return noise;
}

void WheelsConfig::visit(config::FieldVisitor& visitor) {
  visitor.group("noise", noise);
  visitor.number("position_sigma", position_sigma,
                 {"m", {1e-6, 10.0}, "error of a step whatever its length"});
  visitor.number("heading_sigma", heading_sigma,
                 {"rad", {1e-6, 3.2}, "error of a step's turn whatever its size"});
}

MotionPrior wheelPrior(const WheelsConfig& config, const Pose2& T_before_now) {
  const Pose2 step = motion::expectedStep(config.noise, T_before_now, config.noise.scale_mean);
  MotionPrior prior{step, motion::stepCovariance(config.noise, step)};
  const double scale = config.noise.scale_sigma / config.noise.scale_mean;
  prior.covariance.topLeftCorner<2, 2>() +=
      scale * scale * step.translation() * step.translation().transpose();
  const Eigen::Vector3d sigmas(config.position_sigma, config.position_sigma, config.heading_sigma);
  prior.covariance.diagonal() += sigmas.cwiseAbs2();
  return prior;
}

}  // namespace sightline::pipeline
