#include "sightline/fitting/line_fit.h"
#include "sightline/geometry/statistics.h"

#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "monte_carlo.h"

namespace sightline::fitting {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using geometry::kPi;
using geometry::PolarLine;

// χ² with two degrees of freedom.
constexpr double kGate95 = geometry::kChiSquare95Of2;

enum class Noise { kRange, kIsotropic, kRangeAndAngle };

/// A wall as a range sensor at the origin sees it.
struct Wall {
  double rho;
  double phi;
  double first_angle;
  double last_angle;
  int beams;
  double sigma;
  Noise noise;

  PolarLine line() const { return {rho, phi, Matrix2d::Zero()}; }
  double angle(int beam) const {
    return first_angle + (last_angle - first_angle) * beam / (beams - 1);
  }
  double range(int beam) const { return rho / std::cos(phi - angle(beam)); }
  Vector2d direction(int beam) const { return {std::cos(angle(beam)), std::sin(angle(beam))}; }
  double sigmaAcross(int beam) const {
    if (noise == Noise::kRange) return 0.0;
    return noise == Noise::kIsotropic ? sigma : 0.002 * range(beam);
  }
  Matrix2d covariance(int beam) const {
    const Vector2d along = sigma * direction(beam);
    const Vector2d across = sigmaAcross(beam) * direction(beam).unitOrthogonal();
    return along * along.transpose() + across * across.transpose();
  }
};

std::vector<NoisyPoint> exactPoints(const Wall& wall) {
  std::vector<NoisyPoint> points;
  for (int i = 0; i < wall.beams; ++i) {
    points.push_back({wall.range(i) * wall.direction(i), wall.covariance(i)});
  }
  return points;
}

std::vector<NoisyPoint> measure(const Wall& wall, test::Gauss& gauss) {
  auto points = exactPoints(wall);
  for (int i = 0; i < wall.beams; ++i) {
    points[static_cast<std::size_t>(i)].position +=
        gauss(wall.sigma) * wall.direction(i) +
        gauss(wall.sigmaAcross(i)) * wall.direction(i).unitOrthogonal();
  }
  return points;
}

Vector2d errorOf(const PolarLine& fitted, const Wall& wall) {
  return geometry::difference(fitted, wall.line());
}

double objective(const std::vector<NoisyPoint>& points, double rho, double phi) {
  const Vector2d normal(std::cos(phi), std::sin(phi));
  double sum = 0.0;
  for (const NoisyPoint& point : points) {
    const double distance = normal.dot(point.position) - rho;
    sum += distance * distance / normal.dot(point.covariance * normal);
  }
  return sum;
}

class WallFit : public testing::TestWithParam<Wall> {};

INSTANTIATE_TEST_SUITE_P(
    Walls, WallFit,
    testing::Values(Wall{3.0, 0.1, -0.4, 0.5, 60, 0.01, Noise::kRange},            // frontal
                    Wall{3.0, 0.1, -0.4, 0.5, 60, 0.01, Noise::kIsotropic},        //
                    Wall{3.0, 0.1, -0.4, 0.5, 60, 0.01, Noise::kRangeAndAngle},    //
                    Wall{2.0, 1.2, -0.3, 0.3, 60, 0.01, Noise::kRange},            // oblique
                    Wall{2.0, 1.2, -0.3, 0.3, 60, 0.01, Noise::kIsotropic},        //
                    Wall{2.0, 1.2, -0.3, 0.3, 60, 0.01, Noise::kRangeAndAngle},    //
                    Wall{0.5, 1.5, 0.0, 0.4, 40, 0.02, Noise::kRange},             // edge-on
                    Wall{0.5, 1.5, 0.0, 0.4, 40, 0.02, Noise::kIsotropic},         //
                    Wall{4.0, kPi - 0.01, 2.8, 3.4, 20, 0.02, Noise::kIsotropic},  // over the seam
                    Wall{0.3, -2.0, -3.4, -0.6, 100, 0.03, Noise::kRange}));       // close by

TEST_P(WallFit, StartsExactlyWithoutNoise) {
  const auto start = startLine(exactPoints(GetParam()));
  ASSERT_TRUE(start);
  EXPECT_LT(errorOf(*start, GetParam()).norm(), 1e-9);
}

TEST_P(WallFit, StartsNearWithNoise) {
  test::Gauss gauss(1);
  for (int i = 0; i < 100; ++i) {
    const auto start = startLine(measure(GetParam(), gauss));
    ASSERT_TRUE(start);
    EXPECT_LT(errorOf(*start, GetParam()).cwiseAbs().maxCoeff(), 0.05);
  }
}

TEST_P(WallFit, IsExactWithoutNoise) {
  const auto fit = fitLine(exactPoints(GetParam()));
  ASSERT_TRUE(fit);
  EXPECT_LT(errorOf(fit->line, GetParam()).norm(), 1e-9);
  EXPECT_LT(fit->chi_square, 1e-9);
  EXPECT_EQ(fit->degrees_of_freedom, static_cast<std::size_t>(GetParam().beams - 2));
}

TEST_P(WallFit, EndsWhereTheObjectiveIsFlat) {
  test::Gauss gauss(2);
  for (int i = 0; i < 50; ++i) {
    const auto points = measure(GetParam(), gauss);
    const auto fit = fitLine(points);
    ASSERT_TRUE(fit);
    const auto [rho, phi, covariance] = fit->line;
    // A step of a hundredth of the standard deviation to either side.
    const double drho = 0.01 * std::sqrt(covariance(0, 0));
    const double dphi = 0.01 * std::sqrt(covariance(1, 1));
    EXPECT_NEAR(objective(points, rho + drho, phi), objective(points, rho - drho, phi), 1e-3);
    EXPECT_NEAR(objective(points, rho, phi + dphi), objective(points, rho, phi - dphi), 1e-3);
    EXPECT_NEAR(objective(points, rho, phi), fit->chi_square, 1e-9 * fit->chi_square);
    EXPECT_GE(objective(points, rho + 100.0 * drho, phi), fit->chi_square);
    EXPECT_GE(objective(points, rho, phi + 100.0 * dphi), fit->chi_square);
  }
}

// Information of the beams about (ρ, φ) at the true line, by differences of the distances that the
// points' projections on the normal make.
Matrix2d cramerRaoBound(const Wall& wall) {
  Matrix2d information = Matrix2d::Zero();
  for (const NoisyPoint& point : exactPoints(wall)) {
    const auto residual = [&](double rho, double phi) {
      const Vector2d normal(std::cos(phi), std::sin(phi));
      return (normal.dot(point.position) - rho) / std::sqrt(normal.dot(point.covariance * normal));
    };
    constexpr double kStep = 1e-6;
    const Vector2d gradient(
        (residual(wall.rho + kStep, wall.phi) - residual(wall.rho - kStep, wall.phi)) / 2e-6,
        (residual(wall.rho, wall.phi + kStep) - residual(wall.rho, wall.phi - kStep)) / 2e-6);
    information += gradient * gradient.transpose();
  }
  return information.inverse();
}

// The error over many runs: as large as the covariance says (NEES), no larger than the beams allow.
TEST_P(WallFit, IsConsistentUnbiasedAndEfficient) {
  constexpr int kRuns = 2500;
  test::Gauss gauss(3);
  test::Moments<2> errors;
  double nees = 0.0;
  double chi_square = 0.0;
  int inside = 0;
  for (int i = 0; i < kRuns; ++i) {
    const auto fit = fitLine(measure(GetParam(), gauss));
    ASSERT_TRUE(fit);
    const Vector2d error = errorOf(fit->line, GetParam());
    const PolarLine like = geometry::describedLike(GetParam().line(), fit->line);
    const double square = test::normalisedSquare(error, like.covariance);
    errors.add(error);
    nees += square / kRuns;
    inside += square <= kGate95;
    chi_square += fit->chi_square / static_cast<double>(fit->degrees_of_freedom) / kRuns;
  }
  EXPECT_NEAR(nees, 2.0, 0.15);
  EXPECT_GE(inside, 0.93 * kRuns);
  EXPECT_LE(inside, 0.97 * kRuns);
  EXPECT_NEAR(chi_square, 1.0, 0.02);
  const Matrix2d bound = cramerRaoBound(GetParam());
  EXPECT_LT(test::relativeError(errors.covariance(), bound), 0.1);
  EXPECT_LT(test::normalisedSquare(errors.mean(), bound), 20.0 / kRuns);
}

TEST_P(WallFit, DoesNotDependOnAPerturbedStart) {
  test::Gauss gauss(5);
  for (int i = 0; i < 100; ++i) {
    const auto points = measure(GetParam(), gauss);
    const auto fit = fitLine(points);
    ASSERT_TRUE(fit);
    PolarLine start = fit->line;
    start.rho += gauss.uniform(-0.2, 0.2);
    start.phi += gauss.uniform(-0.05, 0.05);
    const auto again = refineLine(points, start);
    ASSERT_TRUE(again);
    const Vector2d apart = geometry::difference(again->line, fit->line);
    EXPECT_LT(test::normalisedSquare(apart, fit->line.covariance), 1e-6);
  }
}

TEST(RangeOnlyFit, HasTheCovarianceOfPearsEquation39) {
  const Wall wall{2.0, 0.4, -0.3, 0.8, 30, 0.02, Noise::kRange};
  Matrix2d information = Matrix2d::Zero();
  for (int i = 0; i < wall.beams; ++i) {
    const double incidence = wall.phi - wall.angle(i);
    // eq. 30
    const Vector2d h(1.0 / std::cos(incidence),
                     wall.rho * std::tan(incidence) / std::cos(incidence));
    information += h * h.transpose() / (wall.sigma * wall.sigma);
  }
  const auto fit = fitLine(exactPoints(wall));
  ASSERT_TRUE(fit);
  EXPECT_LT(test::relativeError<2>(fit->line.covariance, information.inverse()), 1e-6);
}

// --- degenerate input
// -----------------------------------------------------------------------------

NoisyPoint at(double x, double y, double sigma = 0.01) {
  return {{x, y}, sigma * sigma * Matrix2d::Identity()};
}

TEST(DegenerateFit, OfTooFewPointsIsNothing) {
  const PolarLine anything{1.0, 0.0, Matrix2d::Zero()};
  for (const std::vector<NoisyPoint>& points : {std::vector<NoisyPoint>{}, {at(1.0, 2.0)}}) {
    EXPECT_FALSE(startLine(points));
    EXPECT_FALSE(refineLine(points, anything));
    EXPECT_FALSE(fitLine(points));
  }
}

TEST(DegenerateFit, OfPointsInOnePlaceIsNothing) {
  for (const int count : {2, 3, 100}) {
    const std::vector<NoisyPoint> points(static_cast<std::size_t>(count), at(1.1, 2.3));
    EXPECT_FALSE(startLine(points)) << count;
    EXPECT_FALSE(refineLine(points, {1.0, 1.0, Matrix2d::Zero()})) << count;
  }
  EXPECT_FALSE(fitLine({at(0.0, 0.0), at(0.0, 0.0)}));
}

TEST(DegenerateFit, OfTwoPointsIsTheLineThroughThem) {
  const auto fit = fitLine({at(1.0, 2.0), at(3.0, 2.0)});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->line.rho, 2.0, 1e-9);
  EXPECT_NEAR(fit->line.phi, 0.5 * kPi, 1e-9);
  EXPECT_EQ(fit->degrees_of_freedom, 0u);
  EXPECT_NEAR(fit->line.covariance(1, 1), 2e-4 / 4.0, 1e-9);
}

TEST(DegenerateFit, OfPointsInLineWithTheOriginNeedsNoiseAcross) {
  const std::vector<NoisyPoint> isotropic = {at(1.0, 1.0), at(2.0, 2.0), at(3.0, 3.0)};
  const auto fit = fitLine(isotropic);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->line.rho, 0.0, 1e-9);
  EXPECT_NEAR(geometry::wrapOrientation(fit->line.phi + 0.25 * kPi), 0.0, 1e-9);
  // Noise along the beams says nothing of a line that runs along them.
  std::vector<NoisyPoint> along = isotropic;
  for (NoisyPoint& point : along) point.covariance << 1e-4, 1e-4, 1e-4, 1e-4;
  EXPECT_FALSE(fitLine(along));
}

TEST(DegenerateFit, OfWhatIsNoNumberIsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const NoisyPoint& bad : {at(nan, 1.0), at(1.0, nan), at(infinity, 1.0), at(1.0, 1.0, nan)}) {
    const std::vector<NoisyPoint> points = {at(1.0, -1.0), at(1.0, 0.0), bad};
    EXPECT_FALSE(startLine(points));
    EXPECT_FALSE(refineLine(points, {1.0, 0.0, Matrix2d::Zero()}));
    EXPECT_FALSE(fitLine(points));
  }
  const std::vector<NoisyPoint> good = {at(1.0, -1.0), at(1.0, 0.0), at(1.0, 1.0)};
  EXPECT_FALSE(refineLine(good, {nan, 0.0, Matrix2d::Zero()}));
  EXPECT_FALSE(refineLine(good, {1.0, infinity, Matrix2d::Zero()}));
}

TEST(DegenerateFit, OfPointsWithoutNoiseIsNothing) {
  EXPECT_FALSE(fitLine({at(1.0, -1.0, 0.0), at(1.0, 0.0, 0.0), at(1.0, 1.0, 0.0)}));
}

TEST(DegenerateFit, OfACloudIsFiniteOrNothing) {
  test::Gauss gauss(6);
  for (int i = 0; i < 500; ++i) {
    std::vector<NoisyPoint> cloud;
    for (int k = 0; k < 10; ++k) cloud.push_back(at(1.0 + gauss(0.02), gauss(0.02), 0.02));
    const auto fit = fitLine(cloud);
    if (!fit) continue;
    EXPECT_TRUE(std::isfinite(fit->line.rho) && std::isfinite(fit->line.phi));
    EXPECT_GE(fit->line.rho, 0.0);
    EXPECT_GT(fit->line.covariance.determinant(), 0.0);
  }
}

}  // namespace
}  // namespace sightline::fitting
