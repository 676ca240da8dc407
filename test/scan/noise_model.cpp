#include "sightline/scan/noise_model.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "config_error.h"
#include "monte_carlo.h"
#include "sightline/geometry/angle.h"

namespace sightline::scan {
namespace {

using Eigen::Matrix2d;
using geometry::radians;

TEST(NoiseModel, ConstantIgnoresRangeAndIntensity) {
  NoiseModel model;
  model.sigma = 0.03;
  EXPECT_DOUBLE_EQ(model.rangeVariance(1.0), 9e-4);
  EXPECT_DOUBLE_EQ(model.rangeVariance(20.0, 500.0), 9e-4);
}

TEST(NoiseModel, ProportionalGrowsWithTheRange) {
  NoiseModel model;
  model.kind = NoiseKind::kProportional;
  model.sigma = 0.03;
  model.sigma_per_metre = 0.01;
  EXPECT_DOUBLE_EQ(model.rangeVariance(0.0), 9e-4);
  EXPECT_DOUBLE_EQ(model.rangeVariance(4.0), 25e-4);
}

TEST(NoiseModel, IntensityFallsWithTheLight) {
  NoiseModel model;
  model.kind = NoiseKind::kIntensity;
  model.sigma = 0.003;
  model.intensity_sigma = 0.4;
  EXPECT_DOUBLE_EQ(model.rangeVariance(2.0, 100.0), 25e-6);
  EXPECT_GT(model.rangeVariance(2.0, 10.0), model.rangeVariance(2.0, 100.0));
}

TEST(NoiseModel, KeepsAFiniteVarianceWithoutLight) {
  NoiseModel model;
  model.kind = NoiseKind::kIntensity;
  model.intensity_sigma = 0.4;
  for (const double intensity : {0.0, -5.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_GT(model.rangeVariance(2.0, intensity), 1e6);
    EXPECT_TRUE(std::isfinite(model.rangeVariance(2.0, intensity)));
  }
}

TEST(NoiseModel, UniformHasTheVarianceOfItsInterval) {
  NoiseModel model;
  model.kind = NoiseKind::kUniform;
  model.range_half_width = 0.03;
  model.angle_half_width = 0.006;
  EXPECT_DOUBLE_EQ(model.rangeVariance(5.0), 3e-4);
  EXPECT_DOUBLE_EQ(model.angularVariance(), 1.2e-5);
}

TEST(NoiseModel, DirectionsHaveTheirOwnVariance) {
  NoiseModel model;
  model.angular_sigma = 0.002;
  EXPECT_DOUBLE_EQ(model.angularVariance(), 4e-6);
}

TEST(NoiseModel, NamesAFieldThatIsOutOfRange) {
  NoiseModel model;
  config::validate(model);
  model.sigma = 0.0;
  EXPECT_EQ(test::errorOf([&] { config::validate(model); }).key(), "sigma");
  model = {};
  model.range_half_width = -0.1;
  EXPECT_EQ(test::errorOf([&] { config::validate(model); }).key(), "range_half_width");
  const auto document = config::Node::parse("kind: gaussian\n", "noise.yaml");
  EXPECT_EQ(test::errorOf([&] { config::read(document, model); }).key(), "kind");
}

Scan someScan(std::size_t beams) {
  std::vector<double> ranges;
  for (std::size_t i = 0; i < beams; ++i) ranges.push_back(1.0 + static_cast<double>(i));
  return {ScanGeometry::uniform(-0.5, 0.1, beams, 0.0, 0.1, 30.0), 0, std::move(ranges)};
}

TEST(ApplyNoise, FillsOneVarianceABeam) {
  NoiseModel model;
  model.kind = NoiseKind::kProportional;
  model.sigma_per_metre = 0.01;
  model.angular_sigma = 0.001;
  Scan scan = someScan(5);
  applyNoise(model, scan);
  ASSERT_EQ(scan.rangeVariances().size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(scan.rangeVariances()[i], model.rangeVariance(scan.ranges()[i]));
  }
  EXPECT_DOUBLE_EQ(scan.angular_variance, 1e-6);
  EXPECT_EQ(scan.transverse_variance, 0.0);
}

TEST(ApplyNoise, IsotropicIsTheSameInEveryDirection) {
  NoiseModel model;
  model.kind = NoiseKind::kIsotropic;
  model.sigma = 0.05;
  Scan scan = someScan(5);
  applyNoise(model, scan);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT((scan.covariance(i) - 25e-4 * Matrix2d::Identity()).norm(), 1e-17);
  }
}

TEST(ApplyNoise, TakesEachBeamsIntensity) {
  NoiseModel model;
  model.kind = NoiseKind::kIntensity;
  model.intensity_sigma = 0.1;
  Scan scan = someScan(3);
  scan.setIntensities({10.0, 100.0, 0.0});
  applyNoise(model, scan);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scan.rangeVariances()[i],
              model.rangeVariance(scan.ranges()[i], scan.intensities()[i]));
  }
}

struct Beam {
  double range;
  double angle;
  double range_half_width;
  double angle_half_width;
};

class UniformNoise : public testing::TestWithParam<Beam> {};

TEST_P(UniformNoise, CovarianceMatchesMonteCarlo) {
  const auto [range, angle, dr, da] = GetParam();
  const Matrix2d expected = uniformCovariance(range, angle, dr, da);
  test::Gauss random(1);
  test::Moments<2> moments;
  for (int i = 0; i < 100000; ++i) {
    const double r = range + random.uniform(-dr, dr);
    const double a = angle + random.uniform(-da, da);
    moments.add({r * std::cos(a), r * std::sin(a)});
  }
  EXPECT_LT(test::relativeError(moments.covariance(), expected), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Beams, UniformNoise,
                         testing::Values(Beam{3.0, 0.7, 0.025, radians(0.25)},
                                         Beam{8.0, -2.5, 0.025, radians(0.25)},
                                         Beam{1.0, 0.0, 0.025, radians(0.25)},
                                         Beam{5.0, 1.5, 0.5, radians(20.0)}));

TEST(UniformCovariance, HasTheCrossTermOfTheErratum) {
  // jensfelt eq. 4 as printed gives −4.1 m² here.
  const Matrix2d covariance = uniformCovariance(3.0, 0.7, 0.025, radians(0.25));
  EXPECT_NEAR(covariance(0, 1), 7.45e-5, 5e-8);
  EXPECT_EQ(covariance(0, 1), covariance(1, 0));
}

TEST(UniformCovariance, WithoutAngularWidthLiesAlongTheBeam) {
  const Matrix2d covariance = uniformCovariance(3.0, 0.7, 0.03, 0.0);
  const Eigen::Vector2d along(std::cos(0.7), std::sin(0.7));
  EXPECT_LT((covariance - 3e-4 * along * along.transpose()).norm(), 1e-14);
}

TEST(UniformCovariance, IsWhatAScanOfUniformNoiseTellsToFirstOrder) {
  NoiseModel model;
  model.kind = NoiseKind::kUniform;
  model.range_half_width = 0.025;
  model.angle_half_width = radians(0.25);
  Scan scan = someScan(6);
  applyNoise(model, scan);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const Matrix2d exact =
        uniformCovariance(scan.ranges()[i], scan.geometry()->angles()[i], 0.025, radians(0.25));
    EXPECT_LT(test::relativeError(scan.covariance(i), exact), 1e-3);
  }
}

}  // namespace
}  // namespace sightline::scan
