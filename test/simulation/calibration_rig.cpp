// Recordings of a simulated rig, and what calibration makes of them.
#include "sightline/simulation/calibration_rig.h"

#include <cmath>

#include <gmock/gmock.h>

#include "config_error.h"
#include "monte_carlo.h"
#include "sightline/triangulation/calibration_writer.h"
#include "sightline/triangulation/flat_target.h"

namespace sightline::simulation {
namespace {

using test::errorOf;
using testing::HasSubstr;
using testing::Not;
using triangulation::CalibrationRecording;
using triangulation::ParameterEstimate;
using triangulation::ParameterVector;
using triangulation::SensorParameters;

// A sensor as it was built: not quite the nominal one.
SensorParameters builtSensor(unsigned seed) {
  test::Gauss gauss(seed);
  SensorParameters sensor;
  sensor.intrinsics.focal_length *= 1.0 + gauss.uniform(-0.02, 0.02);
  sensor.intrinsics.baseline *= 1.0 + gauss.uniform(-0.02, 0.02);
  sensor.intrinsics.vergence += gauss.uniform(-0.003, 0.003);
  sensor.intrinsics.lens_distance += gauss.uniform(-0.002, 0.002);
  sensor.origin.x += gauss.uniform(-0.005, 0.005);
  sensor.origin.y += gauss.uniform(-0.005, 0.005);
  sensor.origin.projected_vergence += gauss.uniform(-0.01, 0.01);
  return sensor;
}

ParameterVector truthOf(const SensorParameters& sensor) {
  return toVector(sensor.intrinsics, sensor.origin);
}

ParameterEstimate estimate(const CalibrationRecording& recording) {
  return estimateParameters(recording, SensorParameters(), Optics().beam_width, "r.csv");
}

TEST(CalibrationRig, RecordsWholeSpotsWithTheNoiseOfEquation2) {
  const SensorParameters sensor = builtSensor(1);
  RigConfig rig;
  const auto noisy = recordCalibration(sensor, Optics(), rig, 1);
  rig.readings = 1000000;
  const auto still = recordCalibration(sensor, Optics(), rig, 2);
  ASSERT_EQ(noisy.placements.size(), still.placements.size());
  EXPECT_GT(noisy.placements.size(), 45U);
  test::Moments<1> image;
  test::Moments<1> current;
  for (std::size_t i = 0; i < noisy.placements.size(); ++i) {
    for (std::size_t k = 0; k < noisy.placements[i].beams.size(); ++k) {
      const auto& seen = noisy.placements[i].beams[k];
      const auto& truth = still.placements[i].beams[k];
      ASSERT_EQ(seen.beam, truth.beam);
      EXPECT_LT(std::abs(seen.image_position), 0.005);
      const double sigma = sensor.noise_current / std::sqrt(seen.readings);
      current.add(Eigen::Matrix<double, 1, 1>((seen.current - truth.current) / sigma));
      image.add(Eigen::Matrix<double, 1, 1>((seen.image_position - truth.image_position) *
                                            truth.current / (0.005 * sigma)));
    }
  }
  EXPECT_NEAR(std::sqrt(image.covariance()(0, 0)), 1.0, 0.03);
  EXPECT_NEAR(std::sqrt(current.covariance()(0, 0)), 1.0, 0.03);
}

TEST(CalibrationRig, SpotsAreWhereTheModelOfTheBeamHasThem) {
  const SensorParameters sensor;
  const triangulation::ProjectionGeometry geometry(sensor.intrinsics);
  RigConfig rig;
  rig.readings = 1000000;
  double worst_shift = 0.0;
  for (const auto& target : recordCalibration(sensor, Optics(), rig, 3).placements) {
    if (target.stripes || target.depth > 0.6) continue;
    for (const auto& seen : target.beams) {
      const double angle =
          sensor.scan.scanAngle(static_cast<double>(seen.beam)) + sensor.origin.projected_vergence;
      const double depth = target.depth - sensor.origin.x;
      const double axis = geometry.imagePosition(depth / std::cos(angle), angle);
      const auto spot = spotOnTarget(geometry, depth, angle, 0.003);
      EXPECT_NEAR(seen.image_position, axis + spot.shift, 2e-8);
      worst_shift = std::max(worst_shift, std::abs(spot.shift));
    }
  }
  EXPECT_GT(worst_shift, 1e-7);  // or the shift need not be modelled
}

TEST(CalibrationRig, RefusesWhatDoesNotFit) {
  RigConfig rig;
  rig.nearest = 3.0;
  EXPECT_EQ(errorOf([&] { rig.check("s.yaml"); }).key(), "nearest");
  rig = {};
  rig.dark_reflectivity = 0.95;
  EXPECT_EQ(errorOf([&] { rig.check("s.yaml"); }).key(), "dark_reflectivity");
  rig = {};
  rig.striped_depths = {-1.0};
  EXPECT_EQ(errorOf([&] { rig.check("s.yaml"); }).key(), "striped_depths");
}

TEST(ParameterEstimation, ComesNearTheTruth) {
  for (unsigned run = 0; run < 8; ++run) {
    const SensorParameters sensor = builtSensor(100 + run);
    const auto result = estimate(recordCalibration(sensor, Optics(), RigConfig(), run));
    const ParameterVector error = toVector(result.intrinsics, result.origin) - truthOf(sensor);
    EXPECT_NEAR(result.reducedChiSquare(), 1.0, 0.07);
    for (int i = 0; i < triangulation::kParameterCount; ++i) {
      EXPECT_LT(std::abs(error[i]), 4.5 * result.sigma(i)) << i;
    }
    EXPECT_LT(std::abs(error[0] / sensor.intrinsics.focal_length), 0.005);
    EXPECT_LT(std::abs(error[3] / sensor.intrinsics.lens_distance), 0.0075);
    EXPECT_LT(error.segment<2>(4).norm(), 0.15e-3);
  }
}

// A rig of fewer targets than usual, for the sake of more runs: these are independent of each
// other, which the parameters of one run are not.
TEST(ParameterEstimationStatistics, HasTheTruthInItsIntervals) {
  constexpr int kRuns = 200;
  constexpr int kSize = triangulation::kParameterCount;
  constexpr double kChiSquare95Of7 = 14.067140449340169;
  RigConfig rig;
  rig.depths = 8;
  rig.striped_depths = {0.4, 0.6, 0.8, 1.0};
  Eigen::Array<int, kSize, 1> inside = Eigen::Array<int, kSize, 1>::Zero();
  int in_gate = 0;
  double nees = 0.0;
  for (unsigned run = 0; run < kRuns; ++run) {
    const SensorParameters sensor = builtSensor(200 + run);
    const auto result = estimate(recordCalibration(sensor, Optics(), rig, run));
    const ParameterVector error = toVector(result.intrinsics, result.origin) - truthOf(sensor);
    for (int i = 0; i < kSize; ++i)
      inside[i] += std::abs(error[i]) < 1.96 * result.sigma(i) ? 1 : 0;
    const double square = test::normalisedSquare<kSize>(error, result.covariance);
    in_gate += square < kChiSquare95Of7 ? 1 : 0;
    nees += square / kRuns;
  }
  const auto expected = test::binomialRange(kRuns, 0.95);
  for (const int count : inside) {
    EXPECT_GE(count, expected.least);
    EXPECT_LE(count, expected.most);
  }
  EXPECT_GE(inside.sum(), 0.93 * kRuns * kSize);
  EXPECT_LE(inside.sum(), 0.97 * kRuns * kSize);
  EXPECT_GE(in_gate, expected.least);
  EXPECT_LE(in_gate, expected.most);
  EXPECT_NEAR(nees, kSize, 4.0 * std::sqrt(2.0 * kSize / kRuns));
}

// Parameters that the recording of a rig leaves open.
std::string openParameters(const RigConfig& rig, const SensorParameters& sensor = {}) {
  const auto recording = recordCalibration(sensor, Optics(), rig, 5);
  const auto error =
      errorOf([&] { estimateParameters(recording, sensor, Optics().beam_width, "r.csv"); });
  EXPECT_EQ(error.source(), "r.csv");
  EXPECT_THAT(error.reason(), HasSubstr("not determined"));
  return error.key();
}

TEST(ParameterEstimation, NamesWhatTheRecordingDoesNotDetermine) {
  RigConfig no_stripes;
  no_stripes.striped_depths = {};
  EXPECT_EQ(openParameters(no_stripes), "origin.y");

  RigConfig one_depth;
  one_depth.nearest = 1.0;
  one_depth.farthest = 1.0001;
  one_depth.depths = 2;
  const std::string open = openParameters(one_depth);
  EXPECT_THAT(open, HasSubstr("intrinsics.lens_distance"));
  EXPECT_THAT(open, Not(HasSubstr("origin.y")));

  SensorParameters narrow;
  narrow.scan.field_of_view = 0.02;
  RigConfig rig;
  rig.striped_depths = {0.5};
  EXPECT_THAT(openParameters(rig, narrow), HasSubstr("origin.x"));

  const auto nothing = errorOf([] { estimate({}); });
  EXPECT_THAT(nothing.key(), HasSubstr("intrinsics.baseline"));
}

TEST(ParameterEstimation, RefusesWhatIsNoSuchSensor) {
  auto recording = recordCalibration(SensorParameters(), Optics(), RigConfig(), 6);
  for (auto& target : recording.placements) {
    for (auto& seen : target.beams) seen.image_position = -seen.image_position;
  }
  const auto error = errorOf([&] { estimate(recording); });
  EXPECT_EQ(error.source(), "r.csv");
  EXPECT_THAT(error.what(), HasSubstr("no value within its range"));
}

TEST(ParameterEstimation, DoesNotCareAboutTheOrderOfThePlacements) {
  auto recording = recordCalibration(builtSensor(7), Optics(), RigConfig(), 7);
  const auto forward = estimate(recording);
  std::reverse(recording.placements.begin(), recording.placements.end());
  const auto backward = estimate(recording);
  const ParameterVector difference =
      toVector(forward.intrinsics, forward.origin) - toVector(backward.intrinsics, backward.origin);
  for (int i = 0; i < triangulation::kParameterCount; ++i) {
    EXPECT_LT(std::abs(difference[i]), 1e-3 * forward.sigma(i));
  }
}

}  // namespace
}  // namespace sightline::simulation
