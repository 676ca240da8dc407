#include "sightline/motion/odometry_noise.h"

#include <gtest/gtest.h>

#include "config_error.h"
#include "monte_carlo.h"

namespace sightline::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using geometry::Pose2;
using geometry::UncertainPose2;

OdometryNoise noWhiteNoise() {
  OdometryNoise noise;
  noise.distance_sigma = noise.lateral_sigma = 0.0;
  noise.heading_sigma_per_metre = noise.steering_sigma = 0.0;
  return noise;
}

Vector3d errorOf(const Pose2& pose, const Pose2& mean) {
  return {pose.x() - mean.x(), pose.y() - mean.y(),
          geometry::wrapAngle(pose.theta() - mean.theta())};
}

TEST(ExpectedStep, OfAPerfectRobotIsTheMeasuredOne) {
  OdometryNoise noise;
  noise.heading_bias_per_metre = noise.steering_bias = 0.0;
  const Pose2 step(0.3, 0.05, 0.4);
  EXPECT_LT(errorOf(expectedStep(noise, step, 1.0), step).norm(), 1e-15);
}

TEST(ExpectedStep, AppliesTheScaleToTheWayAlone) {
  OdometryNoise noise;
  noise.heading_bias_per_metre = noise.steering_bias = 0.0;
  const Pose2 step(0.3, 0.05, 0.4);
  const Pose2 expected = expectedStep(noise, step, 1.1);
  EXPECT_LT((expected.translation() - 1.1 * step.translation()).norm(), 1e-15);
  EXPECT_NEAR(expected.theta(), 0.4, 1e-15);
}

TEST(ExpectedStep, AddsTheTurnThatWasNotReported) {
  OdometryNoise noise;
  noise.heading_bias_per_metre = 0.01;
  noise.steering_bias = 0.1;
  EXPECT_NEAR(expectedStep(noise, {2.0, 0.0, 0.0}, 1.0).theta(), 0.02, 1e-15);
  EXPECT_NEAR(expectedStep(noise, {-2.0, 0.0, 0.0}, 1.0).theta(), 0.02, 1e-15);
  EXPECT_NEAR(expectedStep(noise, {0.0, 0.0, -0.5}, 1.0).theta(), -0.55, 1e-15);
  // 1 m of arc over 0.5 rad.
  const Pose2 arc = Pose2::exp({1.0, 0.0, 0.5});
  EXPECT_NEAR(expectedStep(noise, arc, 1.0).theta(), 0.56, 1e-15);
}

TEST(ExpectedStep, DoesNotDependOnHowTheWayIsCut) {
  const OdometryNoise noise;
  for (const Vector3d& way : {Vector3d(2.0, 0.0, 0.0), Vector3d(1.0, 0.0, 1.0),
                              Vector3d(0.0, 0.0, 2.0), Vector3d(-1.0, 0.2, 0.5)}) {
    Pose2 cut;
    for (int i = 0; i < 100; ++i) cut = cut * expectedStep(noise, Pose2::exp(way / 100.0), 1.006);
    EXPECT_LT(errorOf(cut, expectedStep(noise, Pose2::exp(way), 1.006)).norm(), 1e-12);
  }
}

TEST(ExpectedStep, OfNoMotionIsNone) {
  EXPECT_EQ(expectedStep(OdometryNoise(), Pose2(), 1.006).coordinates().norm(), 0.0);
}

TEST(StepCovariance, OfNoMotionIsZero) {
  EXPECT_EQ(stepCovariance(OdometryNoise(), Pose2()).norm(), 0.0);
}

TEST(StepCovariance, OfAPerfectRobotIsZero) {
  EXPECT_EQ(stepCovariance(noWhiteNoise(), Pose2(1.0, 0.3, 0.5)).norm(), 0.0);
}

TEST(StepCovariance, OfAMetreHoldsTheSigmasOfTheModel) {
  const OdometryNoise noise;
  const Matrix3d covariance = stepCovariance(noise, {1.0, 0.0, 0.0});
  const double heading = std::pow(noise.heading_sigma_per_metre, 2);
  EXPECT_NEAR(covariance(0, 0), std::pow(noise.distance_sigma, 2), 1e-18);
  EXPECT_NEAR(covariance(1, 1), std::pow(noise.lateral_sigma, 2) + heading / 3.0, 1e-18);
  EXPECT_NEAR(covariance(2, 2), heading, 1e-18);
  EXPECT_NEAR(covariance(1, 2), heading / 2.0, 1e-18);
  EXPECT_NEAR(covariance(0, 2), 0.0, 1e-18);
}

TEST(StepCovariance, SlipsAlongTheWayDriven) {
  OdometryNoise noise = noWhiteNoise();
  noise.distance_sigma = 0.01;
  const Matrix3d sideways = stepCovariance(noise, {0.0, 1.0, 0.0});
  EXPECT_NEAR(sideways(0, 0), 0.0, 1e-18);
  EXPECT_NEAR(sideways(1, 1), 1e-4, 1e-18);
  const Matrix3d backwards = stepCovariance(noise, {-1.0, 0.0, 0.0});
  EXPECT_NEAR(backwards(0, 0), 1e-4, 1e-18);
}

TEST(StepCovariance, IsSymmetricAndNeverNegative) {
  test::Gauss gauss(1);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 step(gauss.uniform(-2.0, 2.0), gauss.uniform(-2.0, 2.0), gauss.uniform(-3.0, 3.0));
    const Matrix3d covariance = stepCovariance(OdometryNoise(), step);
    EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-18);
    EXPECT_TRUE((covariance.ldlt().vectorD().array() > -1e-18).all());
  }
}

// The noise as the model tells it, a small piece of the way at a time.
Pose2 randomWalk(const OdometryNoise& noise, const Vector3d& way, test::Gauss& gauss) {
  constexpr int kSteps = 100;
  const double length = way.head<2>().norm() / kSteps;
  const double turn = std::abs(way[2]) / kSteps;
  const double heading_sigma = std::sqrt(std::pow(noise.heading_sigma_per_metre, 2) * length +
                                         std::pow(noise.steering_sigma, 2) * turn);
  Pose2 pose;
  for (int i = 0; i < kSteps; ++i) {
    Vector3d step = way / kSteps;
    step[0] += gauss(noise.distance_sigma * std::sqrt(length));
    step[1] += gauss(noise.lateral_sigma * std::sqrt(length));
    step[2] += gauss(heading_sigma);
    pose = pose * Pose2::exp(step);
  }
  return pose;
}

struct Drive {
  double length;
  double turn;
};

class RandomWalk : public testing::TestWithParam<Drive> {};

TEST_P(RandomWalk, HasTheCovarianceOfTheStep) {
  const Vector3d way(GetParam().length, 0.0, GetParam().turn);
  OdometryNoise noise;
  noise.heading_sigma_per_metre = 0.02;
  noise.steering_sigma = 0.01;
  const Pose2 end = Pose2::exp(way);
  const Matrix3d expected = stepCovariance(noise, end);
  test::Gauss gauss(2);
  test::Moments<3> moments;
  for (int i = 0; i < 2500; ++i) moments.add(errorOf(randomWalk(noise, way, gauss), end));
  EXPECT_LT(test::relativeError(moments.covariance(), expected), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Ways, RandomWalk,
                         testing::Values(Drive{1.0, 0.0}, Drive{0.1, 0.0}, Drive{-2.0, 0.0},
                                         Drive{0.3, 0.3}, Drive{1.0, -0.5}, Drive{1.0, 1.0}));

TEST(StepCovariance, OfATurnOnTheSpotIsHeadingAlone) {
  OdometryNoise noise;
  noise.steering_sigma = 0.01;
  const Matrix3d covariance = stepCovariance(noise, {0.0, 0.0, -2.0});
  EXPECT_NEAR(covariance(2, 2), 2e-4, 1e-18);
  EXPECT_EQ(covariance(0, 0) + covariance(1, 1), 0.0);
}

// One long step, and the same way in short ones, each composed with what came before.
class CutWay : public testing::TestWithParam<Drive> {};

TEST_P(CutWay, AddsUpToTheSameCovariance) {
  OdometryNoise noise;
  noise.heading_sigma_per_metre = 0.02;
  const Vector3d way(GetParam().length, 0.0, GetParam().turn);
  const Matrix3d whole = stepCovariance(noise, Pose2::exp(way));
  for (const int pieces : {2, 7, 50}) {
    UncertainPose2 sum;
    const Pose2 piece = Pose2::exp(way / pieces);
    for (int i = 0; i < pieces; ++i) {
      sum = compose(sum, UncertainPose2{piece, stepCovariance(noise, piece)});
    }
    const double tolerance = 1e-9 + 0.01 * std::pow(GetParam().turn, 2);
    EXPECT_LT(test::relativeError(sum.covariance, whole), tolerance) << pieces;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, CutWay,
                         testing::Values(Drive{2.0, 0.0}, Drive{1.0, 0.1}, Drive{1.0, -0.5},
                                         Drive{1.0, 1.0}, Drive{0.5, -1.0}));

TEST(OdometryNoise, NamesAFieldThatIsOutOfRange) {
  OdometryNoise noise;
  config::validate(noise);
  noise.distance_sigma = -0.1;
  EXPECT_EQ(test::errorOf([&] { config::validate(noise); }).key(), "distance_sigma");
  noise = {};
  noise.scale_mean = 0.0;
  EXPECT_EQ(test::errorOf([&] { config::validate(noise); }).key(), "scale_mean");
}

}  // namespace
}  // namespace sightline::motion
