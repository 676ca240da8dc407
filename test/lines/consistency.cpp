#include <cmath>

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/geometry/statistics.h"
#include "sightline/lines/line_extractor.h"

// Whether the covariances tell the truth: squared errors in their units (NEES) average to the two
// parameters of a line, and 95 % lie within the gate of 95 %.
namespace sightline::lines {
namespace {

using test::Gauss;
using test::ScanOf;

constexpr double kGate95 = geometry::kChiSquare95Of2;
constexpr int kRuns = 2000;

struct Consistency {
  double mean_nees = 0.0;
  double share_in_gate = 0.0;
  double found = 0.0;
};

Consistency consistencyOf(const ScanOf& scan, unsigned seed) {
  Gauss gauss(seed);
  LineExtractor extractor;
  const geometry::PolarLine truth = (scan.pose.inverse() * scan.walls.front()).line();
  Consistency result;
  for (int i = 0; i < kRuns; ++i) {
    const auto& segments = extractor.extract(scan.take(gauss));
    if (segments.size() != 1) continue;
    const geometry::PolarLine& line = segments[0].line;
    const double nees =
        test::normalisedSquare<2>(geometry::difference(line, truth), line.covariance);
    result.found += 1.0 / kRuns;
    result.mean_nees += nees;
    result.share_in_gate += nees <= kGate95 ? 1.0 : 0.0;
  }
  result.mean_nees /= result.found * kRuns;
  result.share_in_gate /= result.found * kRuns;
  return result;
}

void expectConsistent(const ScanOf& scan, unsigned seed) {
  const Consistency consistency = consistencyOf(scan, seed);
  EXPECT_GT(consistency.found, 0.995);
  EXPECT_NEAR(consistency.mean_nees, 2.0, 0.2);
  EXPECT_GE(consistency.share_in_gate, 0.93);
  EXPECT_LE(consistency.share_in_gate, 0.97);
}

TEST(ConsistencyStatistics, WallSeenFrontally) {
  expectConsistent(test::wallAhead(2.0, -1.5, 1.5), 21);
}

TEST(ConsistencyStatistics, WallToOneSide) {
  expectConsistent(test::wallAhead(2.0, 0.0, 3.0), 22);
}

TEST(ConsistencyStatistics, WallSeenObliquely) {
  expectConsistent(test::wallAhead(1.5, 2.0, 5.0), 23);
}

TEST(ConsistencyStatistics, NoisySensor) {
  ScanOf scan = test::wallAhead(2.0, -1.5, 1.5);
  scan.noise.sigma = 0.03;
  expectConsistent(scan, 24);
}

TEST(ConsistencyStatistics, NoiseThatGrowsWithTheRange) {
  ScanOf scan = test::wallAhead(1.5, 1.0, 6.0);
  scan.noise.kind = scan::NoiseKind::kProportional;
  scan.noise.sigma = 0.003;
  scan.noise.sigma_per_metre = 0.005;
  expectConsistent(scan, 25);
}

TEST(ConsistencyStatistics, NoiseOfTheBeamsDirections) {
  ScanOf scan = test::wallAhead(1.5, 1.0, 4.0);
  scan.noise.sigma = 0.005;
  scan.noise.angular_sigma = 0.003;
  expectConsistent(scan, 26);
}

TEST(ConsistencyStatistics, SensorThatTurnsAndDrivesDuringTheSweep) {
  ScanOf scan = test::wallAhead(2.0, -1.5, 2.5);
  scan.motion = {0.05, 0.01, 0.1};
  expectConsistent(scan, 27);
}

TEST(ConsistencyStatistics, SensorElsewhere) {
  ScanOf scan = test::wallAhead(2.0, -1.5, 1.5);
  scan.pose = {0.4, -0.5, 0.7};
  expectConsistent(scan, 28);
}

// The same whether the sensor stood still or moved: nothing is lost in motion.
TEST(ConsistencyStatistics, MotionDoesNotBias) {
  ScanOf scan = test::wallAhead(2.0, -1.5, 2.5);
  scan.motion = {0.04, -0.02, 0.15};
  LineExtractor extractor;
  const auto& segments = extractor.extract(scan.takeWithoutNoise());
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_NEAR(segments[0].line.rho, 2.0, 1e-4);
  EXPECT_NEAR(segments[0].line.phi, 0.5 * geometry::kPi, 1e-4);
}

}  // namespace
}  // namespace sightline::lines
