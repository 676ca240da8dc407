#include <cmath>

#include <gtest/gtest.h>

#include "lines/noisy_motion.h"
#include "sightline/geometry/statistics.h"
#include "sightline/lines/line_extractor.h"

// Whether the covariances of lines tell the truth where the sensor's motion within the sweep is not
// known exactly (pears eqs 14, 21, 23 and 24).
namespace sightline::lines {
namespace {

using test::Gauss;
using test::NoisySweep;

constexpr int kSweeps = 500;

struct MotionConsistency {
  double found = 0.0;
  double inside = 0.0;
  double nees = 0.0;
  double nees_ignored = 0.0;
};

// The only line of a scan against the wall, as a squared error in standard deviations.
double neesOf(const std::vector<geometry::LineSegment>& segments, const geometry::PolarLine& wall) {
  const Eigen::Vector2d error = geometry::difference(segments[0].line, wall);
  return test::normalisedSquare<2>(error, segments[0].line.covariance);
}

MotionConsistency consistencyOf(const NoisySweep& sweep, unsigned seed) {
  Gauss gauss(seed);
  LineExtractor extractor;
  MotionConsistency result;
  double ignored = 0.0;
  for (int i = 0; i < kSweeps; ++i) {
    scan::Scan scan = sweep.take(gauss);
    const auto& segments = extractor.extract(scan);
    if (segments.size() == 1) {
      const double nees = neesOf(segments, sweep.wall());
      result.found += 1.0;
      result.nees += nees;
      result.inside += nees <= geometry::kChiSquare95Of2 ? 1.0 : 0.0;
    }
    scan.motion_noise = {};
    const auto& without = extractor.extract(scan);
    if (without.size() != 1) continue;
    ignored += 1.0;
    result.nees_ignored += neesOf(without, sweep.wall());
  }
  result.nees /= result.found;
  result.inside /= result.found;
  result.nees_ignored /= ignored;
  result.found /= kSweeps;
  return result;
}

struct WallCase {
  const char* name;
  double distance, from, to;
};
constexpr WallCase kWallCases[] = {{"near", 0.8, -0.6, 0.7}, {"oblique", 1.5, 1.0, 4.0}, {"far", 6.0, -4.0, 3.0}};

void expectConsistent(NoisySweep sweep, const char* what) {
  for (const WallCase& wall : kWallCases) {
    sweep.scan = test::wallAhead(wall.distance, wall.from, wall.to);
    sweep.scan.motion = sweep.motion;
    for (const unsigned seed : {1U, 2U, 3U}) {
      const MotionConsistency of = consistencyOf(sweep, seed);
      std::printf("%s %s: found %.3f nees %.3f inside %.3f ignored %.3f\n", what, wall.name, of.found, of.nees, of.inside, of.nees_ignored);
      EXPECT_GT(of.found, 0.98) << what << ' ' << wall.name;
      EXPECT_NEAR(of.nees, 2.0, 0.25) << what << ' ' << wall.name;
      EXPECT_GE(of.inside, 0.93) << what << ' ' << wall.name;
      EXPECT_LE(of.inside, 0.97) << what << ' ' << wall.name;
    }
  }
}

TEST(MotionNoise, HeadWithJitter) {
  NoisySweep sweep;
  sweep.motion = {0.0, 0.0, 0.3};
  sweep.noise.jitter = std::pow(geometry::radians(0.36), 2);
  sweep.noise.jitter_axis = {-0.05, 0.02};
  expectConsistent(sweep, "jitter");
}

TEST(MotionNoise, OdometryWithTwoPercent) {
  NoisySweep sweep;
  sweep.motion = {0.1, 0.0, 0.3};
  const Eigen::Vector3d sigma = 0.02 * sweep.motion;
  const Eigen::Matrix3d covariance = sigma.cwiseAbs2().asDiagonal();
  sweep.noise.drift = covariance;
  expectConsistent(sweep, "drift");
  sweep.noise.drift.setZero();
  sweep.noise.walk = covariance;
  expectConsistent(sweep, "walk");
}

TEST(MotionNoise, MuchDriftAndWalk) {
  NoisySweep sweep;
  sweep.motion = {0.2, 0.05, 0.4};
  const Eigen::Vector3d sigma(0.02, 0.02, 0.02);
  const Eigen::Matrix3d covariance = sigma.cwiseAbs2().asDiagonal();
  sweep.noise.drift = covariance;
  expectConsistent(sweep, "much drift");
  sweep.noise.drift.setZero();
  sweep.noise.walk = covariance;
  expectConsistent(sweep, "much walk");
}

}  // namespace
}  // namespace sightline::lines
