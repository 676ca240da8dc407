#include "sightline/scan/estimated_noise.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "lines/room_scan.h"

namespace sightline::scan {
namespace {

using test::Gauss;
using test::ScanOf;

double sigmaAt(const Scan& scan, double range) {
  double nearest = std::numeric_limits<double>::infinity();
  double sigma = 0.0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (std::abs(scan.ranges()[i] - range) > nearest) continue;
    nearest = std::abs(scan.ranges()[i] - range);
    sigma = std::sqrt(scan.rangeVariances()[i]);
  }
  return sigma;
}

TEST(EstimatedNoise, IsThatOfTheBeams) {
  for (const double sigma : {0.005, 0.01, 0.03}) {
    Gauss gauss(1);
    ScanOf of = test::room();
    of.noise.sigma = sigma;
    double sum = 0.0;
    for (int i = 0; i < 50; ++i) {
      Scan scan = of.take(gauss);
      scan.setRangeVariances(std::vector<double>(scan.beams(), 0.0));
      raiseToEstimate(scan);
      for (const double variance : scan.rangeVariances()) {
        sum += variance / static_cast<double>(scan.beams());
      }
    }
    EXPECT_NEAR(std::sqrt(sum / 50.0), sigma, 0.1 * sigma);
  }
}

TEST(EstimatedNoise, GrowsWithTheRangeAsThatOfTheBeamsDoes) {
  Gauss gauss(2);
  ScanOf of;
  of.walls = test::rectangle(-1.0, -6.0, 8.0, 1.5);
  of.noise.kind = NoiseKind::kProportional;
  of.noise.sigma = 0.002;
  of.noise.sigma_per_metre = 0.005;
  Scan scan = of.take(gauss);
  scan.setRangeVariances(std::vector<double>(scan.beams(), 0.0));
  raiseToEstimate(scan);
  EXPECT_NEAR(sigmaAt(scan, 1.5), 0.0078, 0.004);
  EXPECT_NEAR(sigmaAt(scan, 7.0), 0.035, 0.015);
  const auto noise = estimateNoise(scan);
  for (std::size_t i = 1; i < noise.size(); ++i) {
    EXPECT_GE(noise[i].range, noise[i - 1].range);
    EXPECT_GE(noise[i].variance, noise[i - 1].variance);
  }
}

TEST(EstimatedNoise, IsNeverBelowTheLeast) {
  Gauss gauss(3);
  ScanOf of = test::room();
  of.noise.sigma = 0.001;
  Scan scan = of.take(gauss);
  NoiseModel unknown;
  unknown.kind = NoiseKind::kEstimated;
  unknown.sigma = 0.01;
  applyNoise(unknown, scan);
  for (const double variance : scan.rangeVariances()) EXPECT_DOUBLE_EQ(variance, 1e-4);
}

TEST(EstimatedNoise, ScansThatTellNothingKeepTheirs) {
  for (const std::size_t beams : {1U, 7U, 20U}) {
    ScanOf of = test::room();
    of.beams = beams;
    Scan scan = of.takeWithoutNoise();
    EXPECT_TRUE(estimateNoise(scan).empty());
    const auto before = scan.rangeVariances();
    raiseToEstimate(scan);
    EXPECT_EQ(scan.rangeVariances(), before);
  }
  Scan scan = test::room().takeWithoutNoise();
  for (std::size_t i = 0; i < scan.beams(); ++i) scan.setKind(i, ReturnKind::kInvalid);
  EXPECT_TRUE(estimateNoise(scan).empty());
}

}  // namespace
}  // namespace sightline::scan
