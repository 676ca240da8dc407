#include "sightline/geometry/pose2.h"

#include <limits>

#include <gtest/gtest.h>

#include "monte_carlo.h"

namespace sightline::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(Pose2, TakesPointsOfItsFrameOut) {
  const Pose2 T_map_robot(1.0, 2.0, 0.5 * kPi);
  const Eigen::Vector2d ahead = T_map_robot * Eigen::Vector2d(3.0, 0.0);
  EXPECT_NEAR(ahead.x(), 1.0, 1e-15);
  EXPECT_NEAR(ahead.y(), 5.0, 1e-15);
}

TEST(Pose2, WrapsItsHeading) {
  EXPECT_EQ(Pose2(0.0, 0.0, -kPi).theta(), kPi);
  EXPECT_NEAR(Pose2(0.0, 0.0, 7.0).theta(), 7.0 - 2.0 * kPi, 1e-15);
}

TEST(Pose2, DrivesAQuarterCircle) {
  // Unit time at speed π/2 and rate π/2: radius 1.
  const Pose2 pose = Pose2::exp({0.5 * kPi, 0.0, 0.5 * kPi});
  EXPECT_NEAR(pose.x(), 1.0, 1e-15);
  EXPECT_NEAR(pose.y(), 1.0, 1e-15);
  EXPECT_NEAR(pose.theta(), 0.5 * kPi, 1e-15);
}

TEST(Pose2, ExpAndLogKeepTheirDigitsWhereTheSeriesEnds) {
  // Either side of the angle at which the closed forms take over.
  for (const double theta : {1e-7, 0.99e-4, 0.999999e-4, 1.000001e-4, 1.01e-4, 1e-3}) {
    const Vector3d tangent(1.0, -2.0, theta);
    const Pose2 pose = Pose2::exp(tangent);
    // exp to third order in the angle.
    EXPECT_NEAR(pose.x(), 1.0 + theta - theta * theta / 6.0, 1e-13 + std::pow(theta, 3));
    EXPECT_LT((pose.log() - tangent).norm(), 1e-14);
  }
}

TEST(Pose2, InterpolatesAlongTheArc) {
  const Pose2 middle = interpolate({0.0, 0.0, 0.0}, {1.0, 1.0, 0.5 * kPi}, 0.5);
  EXPECT_NEAR(middle.x(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(middle.y(), 1.0 - std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(middle.theta(), 0.25 * kPi, 1e-15);
}

TEST(Pose2, InterpolatesTheShortWayOverTheSeam) {
  const Pose2 middle = interpolate({0.0, 0.0, 3.0}, {0.0, 0.0, -3.0}, 0.5);
  EXPECT_NEAR(std::abs(middle.theta()), kPi, 1e-15);
}

TEST(Pose2, KnowsWhetherItIsFinite) {
  EXPECT_TRUE(Pose2(1.0, 2.0, 3.0).isFinite());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(Pose2(nan, 0.0, 0.0).isFinite());
  EXPECT_FALSE(Pose2(0.0, infinity, 0.0).isFinite());
  EXPECT_FALSE(Pose2(0.0, 0.0, infinity).isFinite());
}

Matrix3d someCovariance(double position, double heading, double correlation) {
  const Vector3d sigma(position, 2.0 * position, heading);
  Matrix3d correlations;
  correlations << 1.0, correlation, -correlation, correlation, 1.0, 0.3, -correlation, 0.3, 1.0;
  return sigma.asDiagonal() * correlations * sigma.asDiagonal();
}

Pose2 perturbed(const UncertainPose2& pose, test::Gauss& gauss) {
  return Pose2(pose.mean.coordinates() + gauss(pose.covariance));
}

Vector3d errorOf(const Pose2& pose, const Pose2& mean) {
  return {pose.x() - mean.x(), pose.y() - mean.y(), wrapAngle(pose.theta() - mean.theta())};
}

TEST(UncertainPose2, CompositionMatchesMonteCarlo) {
  const UncertainPose2 a{{1.0, -2.0, 3.1}, someCovariance(0.02, 0.01, 0.5)};
  const UncertainPose2 b{{2.0, 1.0, 0.4}, someCovariance(0.01, 0.02, -0.2)};
  const UncertainPose2 composed = compose(a, b);
  test::Gauss gauss(1);
  test::Moments<3> moments;
  for (int i = 0; i < 40000; ++i) {
    moments.add(errorOf(perturbed(a, gauss) * perturbed(b, gauss), composed.mean));
  }
  EXPECT_LT(test::relativeError(moments.covariance(), composed.covariance), 0.03);
  EXPECT_LT(test::normalisedSquare(moments.mean(), composed.covariance), 0.001);
}

TEST(UncertainPose2, InverseMatchesMonteCarlo) {
  const UncertainPose2 a{{3.0, 1.0, -2.9}, someCovariance(0.02, 0.01, 0.4)};
  const UncertainPose2 inverted = inverse(a);
  test::Gauss gauss(2);
  test::Moments<3> moments;
  for (int i = 0; i < 40000; ++i) {
    moments.add(errorOf(perturbed(a, gauss).inverse(), inverted.mean));
  }
  EXPECT_LT(test::relativeError(moments.covariance(), inverted.covariance), 0.03);
  EXPECT_LT(test::normalisedSquare(moments.mean(), inverted.covariance), 0.001);
}

TEST(UncertainPose2, ACertainIdentityChangesNothing) {
  const UncertainPose2 a{{3.0, 1.0, -2.9}, someCovariance(0.02, 0.01, 0.4)};
  for (const UncertainPose2& same : {compose(a, {}), compose({}, a), inverse(inverse(a))}) {
    EXPECT_LT(errorOf(same.mean, a.mean).norm(), 1e-14);
    EXPECT_LT((same.covariance - a.covariance).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace sightline::geometry
