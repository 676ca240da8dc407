#include "sightline/lines/carrier_step.h"

namespace sightline::lines {

CarrierStep CarrierStep::byWheels(const motion::OdometryNoise& noise,
                                  const geometry::Pose2& T_before_now) {
  const geometry::Pose2 expected = motion::expectedStep(noise, T_before_now, noise.scale_mean);
  return {expected, motion::stepCovariance(noise, expected),
          expected.translation() / noise.scale_mean};
}

Eigen::Matrix2d CarrierStep::noiseAt(const Eigen::Vector2d& now) const {
  Eigen::Matrix<double, 2, 3> effect;
  effect.leftCols<2>() = -T_before_now.rotation().transpose();
  effect.col(2) << now.y(), -now.x();
  return effect * covariance * effect.transpose();
}

}  // namespace sightline::lines
