#include "sightline/geometry/polar_line.h"

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "numeric_jacobian.h"

namespace sightline::geometry {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Pose2 drawPose(test::Gauss& gauss) {
  return {gauss.uniform(-5.0, 5.0), gauss.uniform(-5.0, 5.0), gauss.uniform(-kPi, kPi)};
}

PolarLine drawLine(test::Gauss& gauss) {
  return {gauss.uniform(0.0, 8.0), gauss.uniform(-kPi, kPi), Matrix2d::Zero()};
}

Vector2d apart(const Vector2d& a, const Vector2d& b) {
  return {a[0] - b[0], wrapAngle(a[1] - b[1])};
}

Vector2d coordinates(const PolarLine& line) {
  return {line.rho, line.phi};
}

TEST(PolarLine, MeasuresDistancesFromItsFarSide) {
  const PolarLine line{2.0, 0.5 * kPi, Matrix2d::Zero()};
  EXPECT_NEAR(line.signedDistance({7.0, 5.0}), 3.0, 1e-14);
  EXPECT_NEAR(line.signedDistance({0.0, 0.0}), -2.0, 1e-14);
  EXPECT_LT((line.project({7.0, 5.0}) - Vector2d(7.0, 2.0)).norm(), 1e-14);
  EXPECT_NEAR(line.normal().dot(line.direction()), 0.0, 1e-15);
}

TEST(PolarLine, CanonicalFormIsTheSameLine) {
  Matrix2d covariance;
  covariance << 4.0, 1.0, 1.0, 9.0;
  const PolarLine line = canonical({-2.0, 0.25 * kPi, covariance});
  EXPECT_DOUBLE_EQ(line.rho, 2.0);
  EXPECT_DOUBLE_EQ(line.phi, -0.75 * kPi);
  EXPECT_DOUBLE_EQ(line.covariance(0, 0), 4.0);
  EXPECT_DOUBLE_EQ(line.covariance(1, 1), 9.0);
  EXPECT_DOUBLE_EQ(line.covariance(0, 1), -1.0);
  EXPECT_DOUBLE_EQ(line.covariance(1, 0), -1.0);
}

TEST(PolarLine, OffsetProjectionFrameAgreesWithTheErratum) {
  // pears eq. 15 with the origin of the sensor frame at (0.03, 0.05) in the projection frame, axes
  // parallel: eq. 17 as printed would give 1.7582.
  const PolarLine line_sensor{1.7, 1.1, Matrix2d::Zero()};
  const Pose2 T_sensor_projection(0.03, 0.05, 0.0);
  const PolarLine line_projection = transform(T_sensor_projection.inverse(), line_sensor);
  EXPECT_NEAR(line_projection.rho, 1.6418, 5e-5);
  EXPECT_NEAR(line_projection.phi, 1.1, 1e-15);
}

TEST(PolarLine, TransformAgreesWithMovedPoints) {
  test::Gauss gauss(3);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 T = drawPose(gauss);
    const PolarLine line = drawLine(gauss);
    const PolarLine moved = transform(T, line);
    EXPECT_GE(moved.rho, 0.0);
    EXPECT_GT(moved.phi, -kPi);
    EXPECT_LE(moved.phi, kPi);
    for (const double along : {-10.0, 0.0, 3.0}) {
      const Vector2d point = line.rho * line.normal() + along * line.direction();
      EXPECT_NEAR(moved.signedDistance(T * point), 0.0, 1e-13);
    }
  }
}

TEST(PolarLine, TransformsCompose) {
  test::Gauss gauss(4);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 first = drawPose(gauss);
    const Pose2 second = drawPose(gauss);
    PolarLine line = drawLine(gauss);
    line.covariance << 1e-4, 2e-5, 2e-5, 1e-4;
    const PolarLine stepwise = transform(second, transform(first, line));
    const PolarLine at_once = transform(second * first, line);
    EXPECT_LT(difference(stepwise, at_once).norm(), 1e-12);
    EXPECT_LT((stepwise.covariance - at_once.covariance).norm(), 1e-12);
  }
}

TEST(PolarLine, JacobiansAreTheDerivatives) {
  test::Gauss gauss(5);
  int flipped = 0;
  for (int i = 0; i < 1000; ++i) {
    const Pose2 T = drawPose(gauss);
    const PolarLine line = drawLine(gauss);
    const double before_flip = line.rho + T.translation().dot(T.rotation() * line.normal());
    if (std::abs(before_flip) < 1e-5) continue;  // differences would straddle the jump
    flipped += before_flip < 0.0;
    const auto by_line = [&](const Vector2d& at) {
      return coordinates(transform(T, PolarLine{at[0], at[1], Matrix2d::Zero()}));
    };
    const auto by_pose = [&](const Vector3d& at) {
      return coordinates(transform(Pose2(at), line));
    };
    const Matrix2d numeric_line = test::numericJacobian<2, 2>(by_line, coordinates(line), apart);
    const auto numeric_pose = test::numericJacobian<2, 3>(by_pose, T.coordinates(), apart);
    EXPECT_LT((transformJacobianLine(T, line) - numeric_line).norm(), 1e-7);
    EXPECT_LT((transformJacobianPose(T, line) - numeric_pose).norm(), 1e-7);
  }
  EXPECT_GT(flipped, 100);
}

class PolarLineNoise : public testing::TestWithParam<PolarLine> {};

TEST_P(PolarLineNoise, TransformedCovarianceMatchesMonteCarlo) {
  PolarLine line = GetParam();
  line.covariance << 1e-4, 3e-5, 3e-5, 4e-5;
  UncertainPose2 T{{1.5, -0.7, 2.9}, Matrix3d::Zero()};
  T.covariance << 4e-4, 1e-4, 5e-5, 1e-4, 2e-4, -3e-5, 5e-5, -3e-5, 1e-4;
  const PolarLine expected = transform(T, line);
  test::Gauss gauss(6);
  test::Moments<2> moments;
  for (int i = 0; i < 40000; ++i) {
    const Vector2d noisy = coordinates(line) + gauss(line.covariance);
    const Pose2 noisy_pose(T.mean.coordinates() + gauss(T.covariance));
    const PolarLine moved = transform(noisy_pose, PolarLine{noisy[0], noisy[1], Matrix2d::Zero()});
    moments.add(difference(moved, expected));
  }
  EXPECT_LT(test::relativeError(moments.covariance(), expected.covariance), 0.03);
  EXPECT_LT(test::normalisedSquare(moments.mean(), expected.covariance), 0.001);
}

// Seen from the new frame on the same side, on the other side (ρ changes its sign), and over the
// seam of φ.
INSTANTIATE_TEST_SUITE_P(Lines, PolarLineNoise,
                         testing::Values(PolarLine{3.0, 1.0, Matrix2d::Zero()},
                                         PolarLine{0.5, 0.3, Matrix2d::Zero()},
                                         PolarLine{4.0, 0.2416, Matrix2d::Zero()}));

TEST(PolarLineDifference, IsPlainForLikeDescriptions) {
  const Vector2d d = difference({2.0, 0.5, Matrix2d::Zero()}, {1.9, 0.4, Matrix2d::Zero()});
  EXPECT_NEAR(d[0], 0.1, 1e-15);
  EXPECT_NEAR(d[1], 0.1, 1e-15);
}

TEST(PolarLineDifference, CrossesTheSeamOfTheAngle) {
  const Vector2d d =
      difference({2.0, kPi - 0.01, Matrix2d::Zero()}, {2.0, -kPi + 0.02, Matrix2d::Zero()});
  EXPECT_NEAR(d[0], 0.0, 1e-15);
  EXPECT_NEAR(d[1], -0.03, 1e-14);
}

TEST(PolarLineDifference, CrossesTheOrigin) {
  // Two lines 3 cm apart, one on either side of the origin.
  const Vector2d d =
      difference({0.01, 0.5, Matrix2d::Zero()}, {0.02, 0.49 - kPi, Matrix2d::Zero()});
  EXPECT_NEAR(d[0], -0.03, 1e-15);
  EXPECT_NEAR(d[1], 0.01, 1e-14);
}

TEST(PolarLineDifference, VanishesBetweenTheTwoDescriptionsOfALineThroughTheOrigin) {
  const Vector2d d = difference({0.0, 0.7, Matrix2d::Zero()}, {0.0, 0.7 - kPi, Matrix2d::Zero()});
  EXPECT_NEAR(d.norm(), 0.0, 1e-14);
}

TEST(PolarLineDescribedLike, TakesTheOtherNormalWhereThatIsNearer) {
  PolarLine line{0.02, 0.4 - kPi, Matrix2d::Zero()};
  line.covariance << 4.0, 1.0, 1.0, 9.0;
  const PolarLine reference{0.01, 0.5, Matrix2d::Zero()};
  const PolarLine turned = describedLike(reference, line);
  EXPECT_NEAR(turned.rho, -0.02, 1e-15);
  EXPECT_NEAR(turned.phi, 0.4, 1e-14);
  EXPECT_EQ(turned.covariance(0, 1), -1.0);
  EXPECT_EQ(turned.covariance(1, 1), 9.0);
  const PolarLine kept = describedLike(reference, reference);
  EXPECT_EQ(kept.rho, 0.01);
  EXPECT_EQ(kept.phi, 0.5);
}

}  // namespace
}  // namespace sightline::geometry
