#include "sightline/triangulation/noise_current.h"

#include <cmath>

#include "config_error.h"
#include "monte_carlo.h"

namespace sightline::triangulation {
namespace {

using test::errorOf;

TEST(NoiseCurrent, OfTable2) {
  const auto table =
      config::CsvTable::readFile(SIGHTLINE_SOURCE_DIR "/config/calibration/table2.csv");
  const NoiseCurrentEstimate estimate = estimateNoiseCurrent(readSpreads(table));
  EXPECT_NEAR(estimate.product, 181.1e-15, 0.05e-15);
  EXPECT_NEAR(estimate.noiseCurrent(0.010), 36.22e-12, 0.01e-12);
  EXPECT_NEAR(estimate.free_slope, -1.019, 5e-4);
  // The free line's value at 1 nA, as the paper's units have it.
  EXPECT_NEAR(estimate.free_product, 189.8e-15, 0.05e-15);
}

TEST(NoiseCurrent, IsExactWithoutScatter) {
  std::vector<SpreadAtCurrent> spreads;
  for (const double current : {1e-9, 3e-9, 2e-8}) spreads.push_back({current, 2e-13 / current});
  const auto estimate = estimateNoiseCurrent(spreads);
  EXPECT_NEAR(estimate.product, 2e-13, 1e-24);
  EXPECT_NEAR(estimate.product_sigma, 0.0, 1e-20);
  EXPECT_NEAR(estimate.free_slope, -1.0, 1e-9);
}

TEST(NoiseCurrent, KnowsHowFarItIsOff) {
  test::Gauss gauss(3);
  test::Moments<1> errors;
  for (int run = 0; run < 400; ++run) {
    std::vector<SpreadAtCurrent> spreads;
    for (int i = 1; i <= 20; ++i) {
      spreads.push_back({i * 1e-9, 2e-13 / (i * 1e-9) * std::exp(gauss(0.1))});
    }
    const auto estimate = estimateNoiseCurrent(spreads);
    const double error = (estimate.product - 2e-13) / estimate.product_sigma;
    errors.add(Eigen::Matrix<double, 1, 1>(error));
  }
  EXPECT_NEAR(errors.mean()[0], 0.0, 0.2);
  // Student's t of 19 degrees of freedom: variance 19 / 17.
  EXPECT_NEAR(errors.covariance()(0, 0), 19.0 / 17.0, 0.2);
}

TEST(NoiseCurrent, ReadsEitherUnit) {
  const auto si = readSpreads(config::CsvTable::parse("current_A,image_sigma_m\n2e-9,3e-6\n", ""));
  const auto nano =
      readSpreads(config::CsvTable::parse("image_sigma_um,current_nA\n3,2\n", "n.csv"));
  EXPECT_DOUBLE_EQ(si[0].current, nano[0].current);
  EXPECT_DOUBLE_EQ(si[0].image_position_sigma, nano[0].image_position_sigma);
  const auto missing = config::CsvTable::parse("current_nA\n1\n", "n.csv");
  EXPECT_EQ(errorOf([&] { readSpreads(missing); }).key(), "image_sigma_um, image_sigma_m");
  const auto both = config::CsvTable::parse("current_nA,current_A,image_sigma_m\n1,2,3\n", "n.csv");
  EXPECT_EQ(errorOf([&] { readSpreads(both); }).key(), "current_nA, current_A");
  const auto negative = config::CsvTable::parse("current_nA,image_sigma_um\n1,-2\n", "n.csv");
  EXPECT_EQ(errorOf([&] { readSpreads(negative); }).line(), 2);
}

TEST(NoiseCurrent, RefusesWhatCannotTell) {
  EXPECT_EQ(errorOf([] {
              estimateNoiseCurrent({{1e-9, 1e-6}, {2e-9, 1e-6}}, "n.csv");
            }).source(),
            "n.csv");
  const std::vector<SpreadAtCurrent> alike(5, {1e-9, 1e-6});
  EXPECT_EQ(errorOf([&] { estimateNoiseCurrent(alike); }).reason(),
            "all readings have the same current");
}

}  // namespace
}  // namespace sightline::triangulation
