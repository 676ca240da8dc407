#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <future>
#include <string>
#include <vector>

#include "bench/figures.h"
#include "sightline/simulation/active_sensor_profile.h"
#include "sightline/simulation/random_stream.h"
#include "sightline/triangulation/noise_current.h"
#include "sightline/triangulation/parameter_estimation.h"

/// Calibration from noisy simulated recordings: 1000 sensors, each built a little differently from
/// the nominal one (f and d by 2 %, γ by 0.2°, s by 2 mm, origin by 5 mm, projected vergence by
/// 0.5°, uniformly either way), which is what its calibration starts from.
///
/// sensor.calibration.X_error_percent, .origin_error_mm, .vergence_error_deg: 95th percentiles of
/// the error, vergence being the projected one. .coverage: share of the 95 % intervals with the
/// truth inside, all parameters together; .worst_coverage: of the parameter farthest from 95 %.
namespace sightline::bench {

struct CalibrationRun {
  triangulation::ParameterVector error;
  triangulation::ParameterVector relative_error;
  triangulation::ParameterVector sigma;
};

inline triangulation::SensorParameters builtSensor(const triangulation::SensorParameters& nominal,
                                                   std::uint64_t seed) {
  auto random = simulation::randomStream(seed, 1);
  std::uniform_real_distribution<double> either_way(-1.0, 1.0);
  triangulation::SensorParameters sensor = nominal;
  sensor.intrinsics.focal_length *= 1.0 + 0.02 * either_way(random);
  sensor.intrinsics.baseline *= 1.0 + 0.02 * either_way(random);
  sensor.intrinsics.vergence += geometry::radians(0.2) * either_way(random);
  sensor.intrinsics.lens_distance += 0.002 * either_way(random);
  sensor.origin.x += 0.005 * either_way(random);
  sensor.origin.y += 0.005 * either_way(random);
  sensor.origin.projected_vergence += geometry::radians(0.5) * either_way(random);
  return sensor;
}

inline CalibrationRun calibrateOnce(const simulation::ActiveSensorProfile& profile,
                                    std::uint64_t seed) {
  const auto built = builtSensor(profile.sensor, seed);
  const auto recording = simulation::recordCalibration(built, profile.optics, profile.rig, seed);
  const auto estimate =
      triangulation::estimateParameters(recording, profile.sensor, profile.optics.beam_width);
  const auto truth = toVector(built.intrinsics, built.origin);
  const triangulation::ParameterVector error =
      toVector(estimate.intrinsics, estimate.origin) - truth;
  return {error, error.cwiseQuotient(truth), estimate.covariance.diagonal().cwiseSqrt()};
}

/// Seeds from 1, in two halves side by side.
inline std::vector<CalibrationRun> calibrateMany(const simulation::ActiveSensorProfile& profile,
                                                 std::size_t count) {
  std::vector<CalibrationRun> runs(count);
  const auto every_other = [&](std::size_t first) {
    for (std::size_t i = first; i < count; i += 2) runs[i] = calibrateOnce(profile, i + 1);
  };
  auto even = std::async(std::launch::async, every_other, 0);
  every_other(1);
  even.get();
  return runs;
}

template <class ErrorOf>
double calibrationQuantile(const std::vector<CalibrationRun>& runs, const ErrorOf& error_of) {
  std::vector<double> errors;
  for (const CalibrationRun& run : runs) errors.push_back(std::abs(error_of(run)));
  return quantile(std::move(errors), 0.95);
}

inline double coverageOf(const std::vector<CalibrationRun>& runs, int parameter) {
  double inside = 0.0;
  for (const CalibrationRun& run : runs) {
    inside += std::abs(run.error[parameter]) < 1.96 * run.sigma[parameter] ? 1.0 : 0.0;
  }
  return inside / static_cast<double>(runs.size());
}

inline void printCoverage(const std::vector<CalibrationRun>& runs) {
  double sum = 0.0;
  double worst = 0.95;
  for (int i = 0; i < triangulation::kParameterCount; ++i) {
    const double coverage = coverageOf(runs, i);
    sum += coverage;
    if (std::abs(coverage - 0.95) > std::abs(worst - 0.95)) worst = coverage;
  }
  print("sensor.calibration.coverage", sum / triangulation::kParameterCount, "1");
  print("sensor.calibration.worst_coverage", worst, "1");
}

inline void calibration() {
  const auto profile = simulation::ActiveSensorProfile::readFile(
      SIGHTLINE_SOURCE_DIR "/config/sensors/synchronised_scan.yaml");
  const auto runs = calibrateMany(profile, 1000);
  const std::array<const char*, 4> names{"f", "d", "gamma", "s"};
  for (int i = 0; i < 4; ++i) {
    const double error = calibrationQuantile(
        runs, [i](const CalibrationRun& run) { return 100.0 * run.relative_error[i]; });
    print(
        "sensor.calibration." + std::string(names[static_cast<std::size_t>(i)]) + "_error_percent",
        error, "%");
  }
  const auto of_origin = [](const CalibrationRun& run) {
    return 1e3 * run.error.segment<2>(4).norm();
  };
  const auto of_vergence = [](const CalibrationRun& run) {
    return run.error[6] * 180.0 / geometry::kPi;
  };
  print("sensor.calibration.origin_error_mm", calibrationQuantile(runs, of_origin), "mm");
  print("sensor.calibration.vergence_error_deg", calibrationQuantile(runs, of_vergence), "deg");
  printCoverage(runs);
  const auto table =
      config::CsvTable::readFile(SIGHTLINE_SOURCE_DIR "/config/calibration/table2.csv");
  const auto noise = triangulation::estimateNoiseCurrent(triangulation::readSpreads(table));
  print("sensor.noise_current_um_nA", 1e15 * noise.product, "um*nA");
}

}  // namespace sightline::bench
