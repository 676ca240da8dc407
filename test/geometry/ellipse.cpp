#include "sightline/geometry/ellipse.h"

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/geometry/pose2.h"

namespace sightline::geometry {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Matrix2d turned(double major, double minor, double angle) {
  const Matrix2d rotation = Pose2(0.0, 0.0, angle).rotation();
  return rotation * Vector2d(major * major, minor * minor).asDiagonal() * rotation.transpose();
}

TEST(CovarianceEllipse, FindsAxesAndAngle) {
  for (const double angle : {-1.5, -0.7, 0.0, 0.3, 1.2, 0.5 * kPi}) {
    const Ellipse ellipse = covarianceEllipse(turned(0.3, 0.1, angle), 2.0);
    EXPECT_NEAR(ellipse.major, 0.6, 1e-14);
    EXPECT_NEAR(ellipse.minor, 0.2, 1e-14);
    EXPECT_NEAR(wrapOrientation(ellipse.angle - angle), 0.0, 1e-13);
  }
}

TEST(CovarianceEllipse, IsACircleOrALineAtTheExtremes) {
  const Ellipse circle = covarianceEllipse(Matrix2d::Identity(), 1.0);
  EXPECT_DOUBLE_EQ(circle.major, 1.0);
  EXPECT_DOUBLE_EQ(circle.minor, 1.0);
  const Ellipse line = covarianceEllipse(turned(0.3, 0.0, 0.4), 1.0);
  EXPECT_NEAR(line.major, 0.3, 1e-15);
  EXPECT_NEAR(line.minor, 0.0, 1e-8);
  const Ellipse point = covarianceEllipse(Matrix2d::Zero());
  EXPECT_EQ(point.major, 0.0);
  EXPECT_EQ(point.minor, 0.0);
}

TEST(CovarianceEllipse, HoldsNinetyFivePerCentAtItsUsualScale) {
  const Matrix2d covariance = turned(0.3, 0.05, 0.8);
  const Ellipse ellipse = covarianceEllipse(covariance);
  const Pose2 T_ellipse_map = Pose2(0.0, 0.0, ellipse.angle).inverse();
  test::Gauss gauss(7);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector2d p = T_ellipse_map * gauss(covariance);
    inside += std::hypot(p.x() / ellipse.major, p.y() / ellipse.minor) <= 1.0;
  }
  EXPECT_NEAR(inside / 20000.0, 0.95, 0.005);
}

}  // namespace
}  // namespace sightline::geometry
