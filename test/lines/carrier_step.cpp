// The step of a carrier against numerical derivatives.
#include "sightline/lines/carrier_step.h"

#include <gtest/gtest.h>

namespace sightline::lines {
namespace {

using geometry::Pose2;

const Pose2 kStep(0.3, -0.1, 0.4);
const Eigen::Vector2d kBefore(2.0, 1.0);

TEST(CarrierStep, MovesWhatStandsStillTheOtherWay) {
  const CarrierStep step = CarrierStep::byScans({kStep, Eigen::Matrix3d::Zero()});
  EXPECT_TRUE(step.seenNow(kBefore).isApprox(kStep.inverse() * kBefore));
  EXPECT_TRUE(step.noiseAt(step.seenNow(kBefore)).isZero());
}

TEST(CarrierStep, NoiseIsThatOfItsCoordinates) {
  const auto seen = [](const Eigen::Vector3d& coordinates) -> Eigen::Vector2d {
    return Pose2(coordinates).inverse() * kBefore;
  };
  Eigen::Matrix3d covariance;
  covariance << 4e-4, 1e-5, 2e-5, 1e-5, 3e-4, -1e-5, 2e-5, -1e-5, 1e-4;
  const CarrierStep step = CarrierStep::byScans({kStep, covariance});
  Eigen::Matrix<double, 2, 3> jacobian;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d shift = 1e-6 * Eigen::Vector3d::Unit(i);
    jacobian.col(i) =
        (seen(kStep.coordinates() + shift) - seen(kStep.coordinates() - shift)) / 2e-6;
  }
  EXPECT_TRUE(step.noiseAt(step.seenNow(kBefore))
                  .isApprox(jacobian * covariance * jacobian.transpose(), 1e-6));
}

TEST(CarrierStep, ScaleMovesPlacesAsItsDerivativeSays) {
  motion::OdometryNoise noise;
  const auto seen = [&](double scale) -> Eigen::Vector2d {
    return motion::expectedStep(noise, kStep, scale).inverse() * kBefore;
  };
  const CarrierStep step = CarrierStep::byWheels(noise, kStep);
  const Eigen::Vector2d numeric =
      (seen(noise.scale_mean + 1e-6) - seen(noise.scale_mean - 1e-6)) / 2e-6;
  EXPECT_TRUE(step.scaleEffect().isApprox(numeric, 1e-6));
}

}  // namespace
}  // namespace sightline::lines
