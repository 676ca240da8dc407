#include "sightline/dead_reckoning/error_state.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

constexpr double kStepTime = 0.2;  // s
constexpr int kSteps = 40;

// Fast enough for its bound to play no part.
CarrierConfig carrier() {
  CarrierConfig carrier;
  carrier.max_speed = 50.0;
  carrier.max_turn_rate = 50.0;
  return carrier;
}

// A carrier whose velocity wanders, followed by one that never learns of it.
TEST(ErrorState, WithoutAMatchThePoseGoesOnWithTheTwistsError) {
  ErrorState errors;
  const Eigen::Vector3d twist(0.5, 0.0, 0.0);
  Pose2 pose;
  double sigma = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const StepPrediction prediction = predictStep(carrier(), twist, kStepTime);
    sigma = std::sqrt(prediction.covariance(0, 0));
    errors.advance(pose, prediction, {0, pose, prediction.step, kStepTime}, {});
    pose = pose * prediction.step;
  }
  std::mt19937_64 random(1);
  std::normal_distribution<double> wander(0.0, sigma);
  double squares = 0.0;
  constexpr int kRuns = 20000;
  for (int run = 0; run < kRuns; ++run) {
    double step = 0.0;
    double error = 0.0;
    for (int i = 0; i < kSteps; ++i) error += step += wander(random);
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(errors.pose()(0, 0)), std::sqrt(squares / kRuns),
              0.05 * std::sqrt(squares / kRuns));
}

TEST(ErrorState, StaysPositiveDefiniteWhateverIsMeasured) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  ErrorState errors;
  Pose2 pose;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d twist(unit(random), 0.0, 2.0 * unit(random) - 1.0);
    const StepPrediction prediction = predictStep(CarrierConfig(), twist, kStepTime);
    // Along a corridor of any direction nothing is measured.
    const double direction = 6.0 * unit(random);
    const Eigen::Vector3d across(-std::sin(direction), std::cos(direction), 0.0);
    PoseMeasurement measurement;
    measurement.information = 1e6 * across * across.transpose();
    measurement.information(2, 2) += i % 3 == 0 ? 0.0 : 1e6;
    measurement.common = 0.9 * unit(random);
    const Eigen::Matrix3d step =
        errors.advance(pose, prediction, {0, pose, prediction.step, kStepTime}, measurement);
    pose = pose * prediction.step;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(step).eigenvalues().minCoeff(), 0.0);
    EXPECT_GT(
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(errors.pose()).eigenvalues().minCoeff(),
        0.0);
    errors.handOver(i % 4 == 0 ? unit(random) : 0.0);
  }
}

TEST(ErrorState, AMatchBoundsTheErrorAgainstTheReference) {
  ErrorState errors;
  PoseMeasurement measurement;
  measurement.information = Eigen::Vector3d(1e4, 1e4, 1e5).asDiagonal();
  Pose2 pose;
  for (int i = 0; i < kSteps; ++i) {
    const StepPrediction prediction = predictStep(CarrierConfig(), {0.5, 0.0, 0.3}, kStepTime);
    errors.advance(pose, prediction, {0, pose, prediction.step, kStepTime}, measurement);
    pose = pose * prediction.step;
  }
  EXPECT_LE(errors.againstReference()(0, 0), 1.001e-4);
  EXPECT_LE(errors.againstReference()(2, 2), 1.001e-5);
  // The reference was never added to: the pose in odom is as well known.
  EXPECT_NEAR(errors.pose()(0, 0), errors.againstReference()(0, 0), 1e-7);
}

// The part of a pose's error that the motion within a sweep made goes away with the next match.
TEST(ErrorState, TheErrorOfASweepsMotionIsMatchedAwayByTheNext) {
  ErrorState errors;
  PoseMeasurement measurement;
  measurement.information = Eigen::Vector3d(1e6, 1e6, 1e6).asDiagonal();
  const StepPrediction prediction = predictStep(CarrierConfig(), {0.5, 0.0, 0.3}, kStepTime);
  PoseMeasurement noisy = measurement;
  noisy.motion_covariance = Eigen::Vector3d(1e-2, 1e-2, 1e-3).asDiagonal();
  Pose2 pose;
  const auto take = [&](const PoseMeasurement& taken) {
    const Eigen::Matrix3d step =
        errors.advance(pose, prediction, {0, pose, prediction.step, kStepTime}, taken);
    pose = pose * prediction.step;
    return step;
  };
  take(noisy);
  errors.handOver(0.5);
  EXPECT_GT(errors.pose()(0, 0), 1e-2);
  EXPECT_GT(errors.againstReference()(0, 0), 1e-2);
  // The step back from it has the error once more.
  EXPECT_GT(take(measurement)(0, 0), 0.9e-2);
  EXPECT_LT(errors.pose()(0, 0), 1e-3);
}

// A reference that begins with a scan shows its surfaces where the motion within it put them.
TEST(ErrorState, AFirstScansMotionIsInTheStepAwayFromIt) {
  ErrorState errors;
  errors.displace(Eigen::Vector3d(1e-2, 1e-2, 1e-3).asDiagonal());
  errors.handOver(1.0);
  EXPECT_TRUE(errors.pose().isZero(0.0));
  EXPECT_DOUBLE_EQ(errors.againstReference()(0, 0), 1e-2);
  PoseMeasurement measurement;
  measurement.information = 1e6 * Eigen::Matrix3d::Identity();
  measurement.common = 0.5;
  const StepPrediction prediction = predictStep(CarrierConfig(), {0.5, 0.0, 0.0}, kStepTime);
  const Eigen::Matrix3d step =
      errors.advance({}, prediction, {0, {}, prediction.step, kStepTime}, measurement);
  EXPECT_NEAR(step(0, 0), 1e-2, 1e-3);
}

}  // namespace
}  // namespace sightline::dead_reckoning
