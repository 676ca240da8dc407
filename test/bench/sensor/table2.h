#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/figures.h"
#include "monte_carlo.h"
#include "sightline/simulation/active_sensor_profile.h"
#include "sightline/simulation/detector.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::bench {

/// Measurements of pears, 1000 readings a row.
struct Table2Row {
  const char* name;
  double depth;        // z [m]
  double range_sigma;  // σ_z [m]
  double current;      // I₀ [A]
  double image_sigma;  // Δp [m]
};
constexpr Table2Row kTable2[] = {
    {"0.75", 0.75, 0.05e-2, 48.0e-9, 3.81e-6},   {"1.0", 1.0, 0.148e-2, 26.0e-9, 6.615e-6},
    {"1.25", 1.25, 0.463e-2, 16.0e-9, 11.3e-6},  {"1.5", 1.5, 0.798e-2, 11.0e-9, 15.745e-6},
    {"1.75", 1.75, 1.568e-2, 8.3e-9, 22.095e-6}, {"2.0", 2.0, 2.547e-2, 6.4e-9, 29.265e-6},
    {"2.25", 2.25, 3.713e-2, 5.0e-9, 35.28e-6},  {"2.5", 2.5, 7.662e-2, 4.3e-9, 45.07e-6},
};

/// A white target across the beam that points straight ahead.
inline world::World whiteTarget(double depth) {
  world::World world;
  const std::size_t white = world.addMaterial({"white", 1.0});
  world.add(world::WorldSegment{{{depth, 1.0}, {depth, -1.0}}, 0.0, 2.0, white});
  return world;
}

inline std::size_t beamAhead(const scan::ScanGeometry& geometry) {
  const auto& angles = geometry.angles();
  const auto nearer = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::min_element(angles.begin(), angles.end(), nearer) -
                                  angles.begin());
}

/// Readings of one target as the sensor gives them.
struct Readings {
  double current = 0.0;
  double image_sigma = 0.0;
  double depth_sigma = 0.0;
  double variance_ratio = 0.0;  ///< mean of the predicted variances over the observed one
};

/// The spots of some beams about one, of a target; the others stay dark.
class TargetSpots {
 public:
  TargetSpots(const simulation::ActiveSensorProfile& profile, const scan::ScanGeometry& geometry,
              double depth, std::size_t beam)
      : first_(beam - kAround), raw_{1, {}, std::vector<double>(geometry.beams(), 0.0)} {
    const simulation::OpticalHead head(profile.sensor.intrinsics, profile.optics);
    const world::World world = whiteTarget(depth);
    const Eigen::Isometry3d T_map_projection(Eigen::Translation3d(0, 0, 1));
    for (std::size_t i = first_; i <= beam + kAround; ++i) {
      spots_.push_back(head.look(world, T_map_projection, geometry.angles()[i]));
    }
    raw_.currents.resize(geometry.beams());
  }
  const triangulation::RawScan& measure(simulation::Detector& detector) {
    for (std::size_t i = 0; i < spots_.size(); ++i) {
      raw_.currents[first_ + i] = detector.measure(spots_[i]);
    }
    return raw_;
  }

 private:
  static constexpr std::size_t kAround = 8;
  std::size_t first_;
  std::vector<simulation::SpotImage> spots_;
  triangulation::RawScan raw_;
};

/// Through whole scans, as they are published, but for the limits of range: a target at the
/// farthest one would be cut in two by them.
inline Readings readRepeatedly(const simulation::ActiveSensorProfile& profile, double depth,
                               std::uint64_t seed) {
  constexpr int kReadings = 20000;
  const triangulation::Ranger ranger(profile.calibrated());
  const std::size_t beam = beamAhead(*ranger.geometry());
  const double length = profile.sensor.intrinsics.detector_length;
  simulation::Detector detector(profile.sensor.noise_current, length, profile.bandwidth,
                                profile.sensor.scan.sample_rate, seed);
  TargetSpots spots(profile, *ranger.geometry(), depth, beam);
  test::Moments<5> moments;  // current, image position, depth, range, variance
  for (int i = 0; i < kReadings; ++i) {
    const triangulation::RawScan& raw = spots.measure(detector);
    const scan::Scan scan = ranger.range(raw).scan;
    Eigen::Matrix<double, 5, 1> sample;
    sample << scan.intensities()[beam], triangulation::imagePosition(raw.currents[beam], length),
        scan.ranges()[beam] * scan.geometry()->cosines()[beam], scan.ranges()[beam],
        scan.rangeVariances()[beam];
    moments.add(sample);
  }
  const Eigen::Matrix<double, 5, 1> variances = moments.covariance().diagonal();
  return {moments.mean()[0], std::sqrt(variances[1]), std::sqrt(variances[2]),
          moments.mean()[4] / variances[3]};
}

inline void table2(const simulation::ActiveSensorProfile& profile) {
  std::vector<double> range_ratios;
  for (const Table2Row& row : kTable2) {
    const Readings readings = readRepeatedly(profile, row.depth, range_ratios.size() + 1);
    const std::string name = fmt::format("sensor.table2.{}.", row.name);
    range_ratios.push_back(readings.depth_sigma / row.range_sigma);
    print(name + "current_ratio", readings.current / row.current, "1");
    print(name + "image_sigma_ratio", readings.image_sigma / row.image_sigma, "1");
    print(name + "range_sigma_ratio", range_ratios.back(), "1");
    print(fmt::format("sensor.variance_ratio.{}", row.name), readings.variance_ratio, "1");
  }
  std::sort(range_ratios.begin(), range_ratios.end());
  print("sensor.table2.median_range_sigma_ratio", 0.5 * (range_ratios[3] + range_ratios[4]), "1");
}

}  // namespace sightline::bench
