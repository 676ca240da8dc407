#include "sightline/scan/learned_noise.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lines/room_scan.h"

namespace sightline::scan {
namespace {

using test::Gauss;
using test::ScanOf;

NoiseModel constant(double sigma) {
  NoiseModel noise;
  noise.sigma = sigma;
  return noise;
}

NoiseModel proportional(double sigma, double per_metre) {
  NoiseModel noise = constant(sigma);
  noise.kind = NoiseKind::kProportional;
  noise.sigma_per_metre = per_metre;
  return noise;
}

ScanOf roomWith(const NoiseModel& noise) {
  ScanOf of = test::room();
  of.noise = noise;
  return of;
}

RangeNoise learnedFrom(const ScanOf& of, int scans, unsigned seed) {
  Gauss gauss(seed);
  LearnedNoise learned;
  for (int i = 0; i < scans; ++i) {
    Scan scan = of.take(gauss);
    learned.apply(scan);
  }
  return learned.noise();
}

double sigmaAt(const RangeNoise& noise, double range) {
  return std::sqrt(noise.variance(range));
}

/// A share of the beams sees something nearer, anywhere in front of the wall.
void putStepsInto(Scan& scan, double share, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (uniform(random) < share) scan.setRange(i, 0.05 + uniform(random) * scan.ranges()[i]);
  }
}

/// Share of the beams with which so large a share of all threes of neighbours holds a step.
double shareOfBeams(double of_threes) {
  return 1.0 - std::cbrt(1.0 - of_threes);
}

TEST(LearnedNoise, IsThatOfTheBeamsFromTheFirstScanOn) {
  for (const double sigma : {0.005, 0.01, 0.03, 0.08}) {
    for (unsigned seed = 1; seed < 20; ++seed) {
      const RangeNoise noise = learnedFrom(roomWith(constant(sigma)), 1, seed);
      EXPECT_TRUE(noise.is_learned);
      EXPECT_NEAR(sigmaAt(noise, 2.5), sigma, 0.15 * sigma);
    }
    EXPECT_NEAR(sigmaAt(learnedFrom(roomWith(constant(sigma)), 16, 1), 2.5), sigma, 0.05 * sigma);
  }
}

TEST(LearnedNoise, GrowsWithTheRangeAsThatOfTheBeamsDoes) {
  ScanOf of;
  of.walls = test::rectangle(-1.0, -6.0, 8.0, 1.5);
  of.noise = proportional(0.005, 0.01);
  const RangeNoise noise = learnedFrom(of, 16, 2);
  for (const double range : {1.5, 4.0, 8.0}) {
    const double truth = std::sqrt(of.noise.rangeVariance(range));
    EXPECT_NEAR(sigmaAt(noise, range), truth, 0.1 * truth) << range;
  }
}

TEST(LearnedNoise, IsNotRaisedBySteps) {
  for (const double share : {0.3, 0.5, 0.6}) {
    std::mt19937 random(3);
    for (unsigned seed = 1; seed < 10; ++seed) {
      Gauss gauss(seed);
      LearnedNoise learned;
      Scan scan = roomWith(constant(0.01)).take(gauss);
      putStepsInto(scan, shareOfBeams(share), random);
      learned.apply(scan);
      EXPECT_NEAR(sigmaAt(learned.noise(), 2.5), 0.01, 0.003) << share;
    }
  }
}

TEST(LearnedNoise, IsNotRaisedByAWorldOfFurniture) {
  Gauss gauss(4);
  std::mt19937 random(4);
  LearnedNoise learned;
  for (int i = 0; i < 300; ++i) {
    Scan scan = roomWith(constant(0.01)).take(gauss);
    putStepsInto(scan, shareOfBeams(0.5), random);
    learned.apply(scan);
  }
  EXPECT_NEAR(sigmaAt(learned.noise(), 2.5), 0.01, 0.001);
}

TEST(LearnedNoise, OfRangesInStepsHoldsTheNoiseOfTheSteps) {
  struct Case {
    double step, sigma;
  };
  // Scanners that count centimetres, and 5 cm.
  for (const Case& of :
       {Case{0.01, 0.006}, Case{0.01, 0.002}, Case{0.05, 0.028}, Case{0.05, 0.01}}) {
    Gauss gauss(5);
    LearnedNoise learned;
    for (int i = 0; i < 16; ++i) {
      Scan scan = roomWith(constant(of.sigma)).take(gauss);
      for (std::size_t k = 0; k < scan.beams(); ++k) {
        scan.setRange(k, of.step * std::round(scan.ranges()[k] / of.step));
      }
      learned.apply(scan);
    }
    const double truth = std::sqrt(of.sigma * of.sigma + of.step * of.step / 12.0);
    EXPECT_NEAR(sigmaAt(learned.noise(), 2.5), truth, 0.1 * truth);
    EXPECT_NEAR(learned.noise().step, of.step, 1e-6);
  }
}

TEST(LearnedNoise, ASceneHardlyChangesWhatWasLearned) {
  Gauss gauss(6);
  std::mt19937 random(6);
  LearnedNoise learned;
  for (int i = 0; i < 32; ++i) {
    Scan scan = roomWith(constant(0.01)).take(gauss);
    learned.apply(scan);
  }
  const double before = sigmaAt(learned.noise(), 2.5);
  for (int i = 0; i < 32; ++i) {
    Scan scan = roomWith(constant(0.01)).take(gauss);
    putStepsInto(scan, shareOfBeams(0.9), random);
    learned.apply(scan);
  }
  EXPECT_NEAR(sigmaAt(learned.noise(), 2.5), before, 0.02 * before);
}

TEST(LearnedNoise, FollowsAScannerThatChanges) {
  Gauss gauss(7);
  LearnedNoise learned;
  for (const double sigma : {0.01, 0.02}) {
    std::vector<Scan> scans;
    for (int i = 0; i < 17; ++i) scans.push_back(roomWith(constant(sigma)).take(gauss));
    for (std::size_t i = 0; i < 17000; ++i) learned.apply(scans[i % scans.size()]);
    EXPECT_NEAR(sigmaAt(learned.noise(), 2.5), sigma, 0.05 * sigma);
  }
}

TEST(LearnedNoise, IsNeverBelowTheLeast) {
  Gauss gauss(8);
  NoiseModel unknown;
  unknown.kind = NoiseKind::kEstimated;
  unknown.least_sigma = 0.004;
  Scan scan = roomWith(constant(0.001)).take(gauss);
  applyNoise(unknown, scan);
  for (const double variance : scan.rangeVariances()) EXPECT_NEAR(variance, 16e-6, 1e-6);
}

TEST(LearnedNoise, ScansThatTellNothingLeaveWhatIsAssumed) {
  NoiseModel unknown;
  unknown.kind = NoiseKind::kEstimated;
  unknown.sigma = 0.02;
  for (const std::size_t beams : {1U, 7U, 20U}) {
    ScanOf of = test::room();
    of.beams = beams;
    Scan scan = of.takeWithoutNoise();
    LearnedNoise learned(unknown);
    learned.apply(scan);
    EXPECT_FALSE(learned.noise().is_learned);
    for (const double variance : scan.rangeVariances()) EXPECT_DOUBLE_EQ(variance, 4e-4);
  }
  Scan scan = test::room().takeWithoutNoise();
  for (std::size_t i = 0; i < scan.beams(); ++i) scan.setKind(i, ReturnKind::kInvalid);
  LearnedNoise learned(unknown);
  learned.apply(scan);
  EXPECT_FALSE(learned.noise().is_learned);
}

}  // namespace
}  // namespace sightline::scan
