#include "sightline/dead_reckoning/motion_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric_jacobian.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

constexpr double kElapsed = 0.2;  // s

TEST(PredictStep, GoesOnWithTheTwistForAShortTime) {
  const Eigen::Vector3d twist(0.5, 0.1, 0.4);
  const StepPrediction prediction = predictStep({}, twist, 1e-3);
  EXPECT_TRUE(prediction.step.coordinates().isApprox(Pose2::exp(1e-3 * twist).coordinates(), 1e-5));
  // The velocity wanders by the carrier's acceleration.
  const CarrierConfig carrier;
  EXPECT_NEAR(std::sqrt(prediction.covariance(0, 0)), 1e-6 * carrier.acceleration, 1e-9);
  EXPECT_NEAR(std::sqrt(prediction.covariance(2, 2)), 1e-6 * carrier.turn_acceleration, 1e-9);
}

TEST(PredictStep, ForgetsTheTwistInALongTime) {
  const CarrierConfig carrier;
  const StepPrediction prediction = predictStep(carrier, {1.0, 0.0, 1.0}, 60.0);
  EXPECT_LT(prediction.step.translation().norm(), 1e-6);
  EXPECT_NEAR(std::sqrt(prediction.covariance(0, 0)), 0.5 * carrier.max_speed * 60.0, 1e-6);
}

TEST(PredictStep, IsNeverFasterThanTheCarrier) {
  const CarrierConfig carrier;
  const Pose2 step = predictStep(carrier, {20.0, 0.0, -20.0}, kElapsed).step;
  EXPECT_LE(step.translation().norm(), carrier.max_speed * kElapsed);
  EXPECT_GE(step.theta(), -carrier.max_turn_rate * kElapsed);
}

TEST(PredictStep, DerivativeByTheTwistIsTheNumericDifference) {
  for (const Eigen::Vector3d& twist :
       {Eigen::Vector3d(0.5, -0.2, 0.8), Eigen::Vector3d(0.3, 0.1, 0.0)}) {
    const auto step = [](const Eigen::Vector3d& at) -> Eigen::Vector3d {
      return predictStep({}, at, kElapsed).step.coordinates();
    };
    const auto numeric = test::numericJacobian<3, 3>(step, twist);
    EXPECT_LT((predictStep({}, twist, kElapsed).by_twist - numeric).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(TwistJacobian, IsTheNumericDifference) {
  for (const Eigen::Vector3d& step :
       {Eigen::Vector3d(0.3, -0.1, 0.5), Eigen::Vector3d(0.1, 0.05, 0.0),
        Eigen::Vector3d(-0.2, 0.4, -2.5)}) {
    const auto twist = [](const Eigen::Vector3d& at) -> Eigen::Vector3d {
      return Pose2(at).log() / kElapsed;
    };
    const auto numeric = test::numericJacobian<3, 3>(twist, step);
    EXPECT_LT((twistJacobian(Pose2(step), kElapsed) - numeric).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(WindowOf, IsThreeStandardDeviationsWide) {
  const Eigen::Vector3d sigmas(0.02, 0.05, 0.03);
  const Eigen::Matrix3d covariance = sigmas.cwiseAbs2().asDiagonal();
  const SearchWindow window = windowOf({}, {{1.0, 2.0, 0.5}, covariance}, kElapsed);
  EXPECT_NEAR(window.position, 0.15, 1e-12);
  EXPECT_NEAR(window.heading, 0.09, 1e-12);
  EXPECT_EQ(window.centre.coordinates(), Eigen::Vector3d(1.0, 2.0, 0.5));
}

TEST(WindowOf, EndsWhereTheCarrierCannotGet) {
  const CarrierConfig carrier;
  const geometry::UncertainPose2 unknown{{}, 100.0 * Eigen::Matrix3d::Identity()};
  const SearchWindow window = windowOf(carrier, unknown, kElapsed);
  EXPECT_DOUBLE_EQ(window.position, carrier.max_speed * kElapsed);
  EXPECT_DOUBLE_EQ(window.heading, carrier.max_turn_rate * kElapsed);
  EXPECT_DOUBLE_EQ(windowOf(carrier, unknown, 60.0).heading, geometry::kPi);
}

}  // namespace
}  // namespace sightline::dead_reckoning
