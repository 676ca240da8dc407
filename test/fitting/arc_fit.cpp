#include "sightline/fitting/arc_fit.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "monte_carlo.h"
#include "sightline/geometry/angle.h"

namespace sightline::fitting {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A disc as a range sensor at the origin sees it.
struct Disc {
  Vector2d centre;
  double radius;
  double step = geometry::radians(0.25);
  double sigma = 0.01;

  ArcObservations look(test::Gauss& gauss, double error = 1.0) const {
    ArcObservations observations;
    const double middle = std::atan2(centre.y(), centre.x());
    const double half = std::asin(radius / centre.norm());
    // The places where beams fall on the disc are up to chance.
    double angle = middle - half - step * gauss.uniform(0.0, 1.0);
    observations.tangents.push_back(tangentAt(angle + 0.5 * step));
    for (angle += step; angle < middle + half; angle += step) {
      observations.returns.push_back(returnAt(angle, error * gauss(sigma)));
    }
    observations.tangents.push_back(tangentAt(angle - 0.5 * step));
    return observations;
  }

  ArcTangent tangentAt(double angle) const {
    const double width = centre.norm() * step;
    return {Vector2d(0, 0), {std::cos(angle), std::sin(angle)}, width * width / 12.0};
  }

  ArcReturn returnAt(double angle, double error) const {
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const double along = direction.dot(centre);
    const double range = along - std::sqrt(radius * radius - centre.squaredNorm() + along * along);
    return {(range + error) * direction, direction, sigma * sigma, 0.0, range * step};
  }

  Vector3d errorOf(const ArcFit& fit) const {
    return {fit.centre.x() - centre.x(), fit.centre.y() - centre.y(), fit.radius - radius};
  }
};

TEST(ArcFit, FindsADiscWithoutNoise) {
  test::Gauss gauss(1);
  for (const double radius : {0.05, 0.2, 1.0}) {
    const Disc disc{{2.0, 1.5}, radius, geometry::radians(0.25), 1e-4};
    ArcObservations observations = disc.look(gauss, 0.0);
    observations.tangents.clear();
    const auto fit = fitArc(observations, 3.5);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->convex);
    EXPECT_LT(disc.errorOf(*fit).norm(), 0.01 * radius);
  }
}

TEST(ArcFit, SeesARoundRoomFromInside) {
  test::Gauss gauss(2);
  const Vector2d centre(0.4, -0.3);
  ArcObservations observations;
  for (double angle = -2.0; angle < 2.0; angle += 0.01) {
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const double along = direction.dot(centre);
    const double range = along + std::sqrt(4.0 - centre.squaredNorm() + along * along);
    observations.returns.push_back(
        {(range + gauss(0.01)) * direction, direction, 1e-4, 0.0, 0.01 * range});
  }
  const auto fit = fitArc(observations, 3.5);
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->convex);
  EXPECT_NEAR(fit->radius, 2.0, 4.0 * std::sqrt(fit->covariance(2, 2)));
  EXPECT_LT((fit->centre - centre).norm(), 0.01);
}

// The inverse information is what the errors are like, and no fit that is right on average can do
// better (Cramér and Rao).
TEST(ArcFit, ErrsAsMuchAsItSays) {
  for (const double radius : {0.05, 0.1, 0.2, 0.5}) {
    test::Gauss gauss(3);
    const Disc disc{{1.8, 1.2}, radius};
    double nees = 0.0;
    int inside = 0;
    int fits = 0;
    Vector3d bias(0, 0, 0);
    for (int i = 0; i < 2000; ++i) {
      const auto fit = fitArc(disc.look(gauss), 3.5);
      if (!fit) continue;
      ++fits;
      const Vector3d error = disc.errorOf(*fit);
      const double square = test::normalisedSquare<3>(error, fit->covariance);
      nees += square;
      bias += error;
      inside += square < 7.815 ? 1 : 0;
    }
    ASSERT_GT(fits, 1980) << radius;
    EXPECT_GT(nees / fits, 2.4) << radius;
    EXPECT_LT(nees / fits, 3.4) << radius;
    EXPECT_GT(inside, 0.93 * fits) << radius;
    EXPECT_LT(inside, 0.985 * fits) << radius;
    EXPECT_LT((bias / fits).norm(), 0.0015) << radius;
  }
}

TEST(ArcFit, AStrayReturnIsLeftOut) {
  test::Gauss gauss(4);
  const Disc disc{{2.0, 0.0}, 0.3};
  ArcObservations observations = disc.look(gauss);
  observations.returns[20].point *= 0.9;
  const auto fit = fitArc(observations, 3.5);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->returns, observations.returns.size() - 1);
  EXPECT_LT(disc.errorOf(*fit).norm(), 0.01);
}

TEST(ArcFit, TwoReturnsOrAStraightLineDetermineNoCircle) {
  test::Gauss gauss(5);
  ArcObservations observations = Disc{{2.0, 0.0}, 0.3}.look(gauss);
  observations.returns.resize(2);
  EXPECT_FALSE(fitArc(observations, 3.5));
  observations = {};
  EXPECT_FALSE(fitArc(observations, 3.5));
  for (double angle = -0.1; angle < 0.1; angle += 0.01) {
    const Vector2d direction(std::cos(angle), std::sin(angle));
    observations.returns.push_back({2.0 / direction.x() * direction, direction, 1e-4, 0.0, 0.02});
  }
  const auto fit = fitArc(observations, 3.5);
  EXPECT_TRUE(!fit || fit->radius > 100.0);
}

}  // namespace
}  // namespace sightline::fitting
