#include "sightline/triangulation/ranger.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/motion/head_command.h"
#include "sightline/triangulation/projection_geometry.h"

namespace sightline::triangulation {
namespace {

using scan::ReturnKind;

Calibration calibration() {
  const SensorParameters parameters;
  return {parameters, modelledTable(parameters, tableDepths(0.35, 2.85, 40))};
}

// Photocurrents without noise.
Photocurrents currentsOf(const Ranger& ranger, std::size_t beam, double range, double total) {
  const SensorParameters& parameters = ranger.calibration().parameters;
  const ProjectionGeometry geometry(parameters.intrinsics);
  const double p = geometry.imagePosition(range, ranger.geometry()->angles()[beam]);
  return photocurrentsAt(p, total, parameters.intrinsics.detector_length);
}

RawScan rawScan(const Ranger& ranger, double range, double total) {
  RawScan raw;
  raw.stamp = 12'345;
  for (std::size_t beam = 0; beam < ranger.geometry()->beams(); ++beam) {
    raw.currents.push_back(currentsOf(ranger, beam, range, total));
    raw.head_angles.push_back(0.0);
  }
  return raw;
}

std::string faultOf(const Ranger& ranger, const RawScan& raw) {
  try {
    ranger.range(raw);
  } catch (const scan::InvalidScan& fault) {
    return fault.what();
  }
  return "none";
}

TEST(Photocurrents, DivideByWhereTheLightFalls) {
  const Photocurrents currents = photocurrentsAt(2e-3, 10e-9, 0.01);
  EXPECT_NEAR(currents.first, 7e-9, 1e-18);
  EXPECT_NEAR(currents.second, 3e-9, 1e-18);
  EXPECT_NEAR(imagePosition(currents, 0.01), 2e-3, 1e-12);
  EXPECT_TRUE(std::isnan(imagePosition({0.0, 0.0}, 0.01)));
  EXPECT_TRUE(std::isnan(imagePosition({-1e-12, 0.0}, 0.01)));
}

// 181.1 um nA of pears table 2.
TEST(Photocurrents, NoiseOfThePositionFallsWithTheCurrent) {
  EXPECT_NEAR(imagePositionSigma(10e-9, 36.22e-12, 0.01), 18.11e-6, 1e-9);
}

// Interpolation between 40 depths costs little beside the noise.
TEST(Ranger, FindsTheRangeThatMadeTheImage) {
  const Ranger ranger(calibration());
  for (const double range : {0.41, 0.6, 1.0, 1.7, 2.3, 2.49}) {
    for (const std::size_t beam : {0, 100, 255}) {
      const double current = 26e-9 / (range * range);
      const RangeReading reading = ranger.read(beam, currentsOf(ranger, beam, range, current));
      EXPECT_EQ(reading.kind, ReturnKind::kValid);
      EXPECT_NEAR(reading.range, range, 0.15 * std::sqrt(reading.variance));
      EXPECT_NEAR(reading.depth, range * ranger.geometry()->cosines()[beam],
                  0.15 * std::sqrt(reading.variance));
    }
  }
}

TEST(Ranger, VarianceIsThatOfTheRange) {
  const Ranger ranger(calibration());
  test::Gauss gauss(5);
  for (const double range : {0.5, 1.2, 2.2}) {
    const double current = 26e-9 / (range * range);
    const double sigma = imagePositionSigma(current, 36.22e-12, 0.01);
    test::Moments<1> ranges;
    test::Moments<1> variances;
    for (int i = 0; i < 20000; ++i) {
      const Photocurrents exact = currentsOf(ranger, 30, range, current);
      const double p = imagePosition(exact, 0.01) + gauss(sigma);
      const RangeReading reading = ranger.read(30, photocurrentsAt(p, current, 0.01));
      ranges.add(Eigen::Matrix<double, 1, 1>(reading.range));
      variances.add(Eigen::Matrix<double, 1, 1>(reading.variance));
    }
    EXPECT_NEAR(variances.mean()[0] / ranges.covariance()(0, 0), 1.0, 0.04);
  }
}

// The variance in a scan is taken at the neighbours' position and does not depend on the range's
// own error.
TEST(RangerStatistics, VarianceInAScanIsThatOfTheRange) {
  const Ranger ranger(calibration());
  test::Gauss gauss(6);
  const double current = 26e-9 / (2.2 * 2.2);
  const double sigma = imagePositionSigma(current, 36.22e-12, 0.01);
  test::Moments<2> moments;  // range and its variance of a beam in the middle
  for (int i = 0; i < 6000; ++i) {
    RawScan raw = rawScan(ranger, 2.2, current);
    for (Photocurrents& exact : raw.currents) {
      exact = photocurrentsAt(imagePosition(exact, 0.01) + gauss(sigma), current, 0.01);
    }
    const scan::Scan scan = ranger.range(raw).scan;
    moments.add({scan.ranges()[128], scan.rangeVariances()[128]});
  }
  const Eigen::Matrix2d covariance = moments.covariance();
  EXPECT_NEAR(moments.mean()[1] / covariance(0, 0), 1.0, 0.06);
  EXPECT_NEAR(covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)), 0.0, 0.05);
}

TEST(Ranger, SortsWhatIsOutsideByRep117) {
  const Ranger ranger(calibration());
  const auto kindOf = [&](double range, double current) {
    return ranger.read(128, currentsOf(ranger, 128, range, current)).kind;
  };
  EXPECT_EQ(kindOf(0.39, 1e-7), ReturnKind::kTooNear);
  EXPECT_EQ(kindOf(0.2, 1e-7), ReturnKind::kTooNear);
  EXPECT_EQ(kindOf(2.55, 4e-9), ReturnKind::kNothing);
  EXPECT_EQ(kindOf(3.5, 4e-9), ReturnKind::kNothing);
  EXPECT_EQ(kindOf(1.0, 0.7e-9), ReturnKind::kInvalid);
  EXPECT_EQ(kindOf(1.0, 0.0), ReturnKind::kInvalid);
  EXPECT_EQ(kindOf(1.0, std::nan("")), ReturnKind::kInvalid);
}

TEST(Ranger, MakesAScanOfWhatTheSensorDelivers) {
  const Ranger ranger(calibration());
  const motion::RangeScan result = ranger.range(rawScan(ranger, 1.0, 25e-9));
  EXPECT_EQ(result.scan.stamp, 12'345);
  EXPECT_EQ(result.scan.beams(), 256u);
  EXPECT_TRUE(result.scan.sensorMotion().empty());
  EXPECT_NEAR(result.scan.intensities()[7], 25e-9, 1e-15);
  EXPECT_NEAR(result.scan.geometry()->timeOffsets()[10], 0.004, 1e-12);
  EXPECT_NEAR(result.scan.geometry()->angles()[0], geometry::radians(-18.5), 1e-9);
  EXPECT_NEAR(result.head.origin.x(), 0.05, 1e-12);
}

// What one pole made of a scan with an edge, is the scan again; but for the first sample.
TEST(Ranger, LagOfTheDetectorIsUndone) {
  const Ranger without(calibration());
  Calibration of_slow = calibration();
  of_slow.parameters.scan.bandwidth = 1000.0;
  const Ranger ranger(of_slow);
  RawScan raw = rawScan(without, 1.0, 1e-8);
  for (std::size_t i = 128; i < 256; ++i) raw.currents[i] = currentsOf(without, i, 1.7, 4e-9);
  const motion::RangeScan expected = without.range(raw);
  const double memory = of_slow.parameters.scan.memory();
  EXPECT_NEAR(memory, 0.081, 1e-3);
  for (std::size_t i = 1; i < 256; ++i) {
    raw.currents[i].first += memory * (raw.currents[i - 1].first - raw.currents[i].first);
    raw.currents[i].second += memory * (raw.currents[i - 1].second - raw.currents[i].second);
  }
  const motion::RangeScan found = ranger.range(raw);
  EXPECT_EQ(found.scan.kinds()[0], ReturnKind::kInvalid);
  const double price = (1.0 + memory) / (1.0 - memory);
  for (std::size_t i = 1; i < 256; ++i) {
    const double variance = price * expected.scan.rangeVariances()[i];
    EXPECT_NEAR(found.scan.ranges()[i], expected.scan.ranges()[i], 1e-9) << i;
    // Beside the first, the median of the neighbours is of one beam less.
    EXPECT_NEAR(found.scan.rangeVariances()[i], variance, 0.005 * variance) << i;
  }
}

TEST(Ranger, RefusesScansThatDoNotFit) {
  const Ranger ranger(calibration());
  RawScan raw = rawScan(ranger, 1.0, 25e-9);
  EXPECT_EQ(faultOf(ranger, raw), "none");
  raw.currents.pop_back();
  EXPECT_EQ(faultOf(ranger, raw), "255 pairs of photocurrents for 256 beams");
  raw = rawScan(ranger, 1.0, 25e-9);
  raw.head_angles.resize(3);
  EXPECT_EQ(faultOf(ranger, raw), "3 head angles for 256 beams");
  raw = rawScan(ranger, 1.0, 25e-9);
  raw.head_angles[9] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(faultOf(ranger, raw), "a head angle that is not finite");
}

}  // namespace
}  // namespace sightline::triangulation
