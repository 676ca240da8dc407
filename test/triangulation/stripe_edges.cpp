#include "sightline/triangulation/stripe_edges.h"

#include <cmath>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/triangulation/flat_target.h"

namespace sightline::triangulation {
namespace {

constexpr double kBeamWidth = 0.003;
constexpr double kBright = 2e-8;  // A
constexpr double kDark = 2e-9;

// Currents of a Gaussian beam on stripes, falling off towards the sides.
TargetPlacement stripedTarget(const SensorParameters& sensor, double depth, const Stripes& stripes,
                              int readings, test::Gauss& gauss) {
  TargetPlacement target;
  target.depth = depth;
  target.stripes = stripes;
  for (int beam = 0; beam < sensor.scan.beams; ++beam) {
    const double angle = sensor.scan.scanAngle(beam) + sensor.origin.projected_vergence;
    const double ahead = depth - sensor.origin.x;
    double current = kDark;
    for (int i = -30; i < 30; ++i) {
      const double aside = ahead * std::tan(angle) + sensor.origin.y - stripes.edgeAt(i);
      const double share = powerBeyond(aside * std::cos(angle), kBeamWidth);
      current += (i % 2 == 0 ? 1.0 : -1.0) * share * (kBright - kDark);
    }
    current *= std::pow(std::cos(angle), 3);
    current += gauss(sensor.noise_current) / std::sqrt(readings);
    target.beams.push_back({static_cast<std::size_t>(beam), readings, 0.0, current});
  }
  return target;
}

double trueAngle(const SensorParameters& sensor, const StripeEdge& edge) {
  return std::atan2(edge.y - sensor.origin.y, edge.depth - sensor.origin.x) -
         sensor.origin.projected_vergence;
}

TEST(StripeEdges, AreFoundWhereTheyAre) {
  const SensorParameters sensor;
  test::Gauss gauss(1);
  const auto target = stripedTarget(sensor, 0.6, {0.012, 0.05}, 40, gauss);
  const auto edges = findStripeEdges(target, sensor, kBeamWidth);
  ASSERT_GE(edges.size(), 6U);
  for (const StripeEdge& edge : edges) {
    EXPECT_EQ(edge.depth, 0.6);
    EXPECT_NEAR(std::remainder(edge.y - 0.012, 0.05), 0.0, 1e-12);
    EXPECT_NEAR(edge.scan_angle, trueAngle(sensor, edge), 2e-5);
  }
}

TEST(StripeEdges, KnowHowFarTheyAreOff) {
  const SensorParameters sensor;
  test::Gauss gauss(2);
  // Beams 1 mm apart, 3 mm apart, and so far apart that some edges lie between two of them unseen.
  for (const double depth : {0.4, 1.0, 2.0}) {
    test::Moments<1> errors;
    double least = 1.0;
    double most = 0.0;
    for (int run = 0; run < 60; ++run) {
      const Stripes stripes{gauss.uniform(0.0, 0.1), 0.08};
      const auto target = stripedTarget(sensor, depth, stripes, 1, gauss);
      for (const StripeEdge& edge : findStripeEdges(target, sensor, kBeamWidth)) {
        const double error = (edge.scan_angle - trueAngle(sensor, edge)) / edge.sigma;
        errors.add(Eigen::Matrix<double, 1, 1>(error));
        least = std::min(least, edge.sigma);
        most = std::max(most, edge.sigma);
      }
    }
    EXPECT_GT(errors.count(), 100) << depth;
    EXPECT_NEAR(errors.mean()[0], 0.0, 0.2) << depth;
    EXPECT_NEAR(std::sqrt(errors.covariance()(0, 0)), 1.0, 0.15) << depth;
    // At 2 m the gap is two fifths of the beams' spacing.
    if (depth > 1.5) {
      EXPECT_GT(most, 2e-4);
    }
    EXPECT_LT(least, 2e-5);
  }
}

TEST(StripeEdges, AreToldApartByTheNominalOriginToAStripe) {
  SensorParameters sensor;
  test::Gauss gauss(3);
  const auto target = stripedTarget(sensor, 0.8, {0.012, 0.05}, 40, gauss);
  const auto edges = findStripeEdges(target, sensor, kBeamWidth);
  sensor.origin.y += 0.04;
  const auto from_afar = findStripeEdges(target, sensor, kBeamWidth);
  ASSERT_EQ(edges.size(), from_afar.size());
  for (std::size_t i = 0; i < edges.size(); ++i) EXPECT_EQ(edges[i].y, from_afar[i].y);
}

TEST(StripeEdges, AreNotFoundWhereThereAreNoneOrTooClose) {
  const SensorParameters sensor;
  test::Gauss gauss(4);
  auto target = stripedTarget(sensor, 0.8, {-5.0, 0.05}, 40, gauss);
  EXPECT_TRUE(findStripeEdges(target, sensor, kBeamWidth).empty());
  target = stripedTarget(sensor, 1.5, {0.0, 0.012}, 40, gauss);
  EXPECT_TRUE(findStripeEdges(target, sensor, kBeamWidth).empty());
  target = stripedTarget(sensor, 0.8, {0.0, 0.05}, 40, gauss);
  target.beams.resize(3);
  EXPECT_TRUE(findStripeEdges(target, sensor, kBeamWidth).empty());
  target.stripes.reset();
  EXPECT_TRUE(findStripeEdges(target, sensor, kBeamWidth).empty());
}

}  // namespace
}  // namespace sightline::triangulation
