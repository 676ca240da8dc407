#pragma once

#include <random>
#include <string>

#include <Eigen/Cholesky>

#include "bench/figures.h"
#include "bench/gaze/rig.h"
#include "sightline/geometry/statistics.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::bench {

/// Lines of a wall while the head turns past it: with the head's angles in steps and with noise,
/// against the maximum-likelihood fit of the same beams with exact angles.
class HeadFigures {
 public:
  explicit HeadFigures(double rate) : rate_(rate), profile_(activeSensor()) {}

  void run(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    simulation::ActiveSensor sensor(profile_, seed);
    const triangulation::Ranger ranger(profile_.calibrated());
    // A white wall before the sensor, from another distance in each run.
    const double rho = 0.9 + 0.1 * static_cast<double>(seed % 7);
    world::World world;
    const std::size_t white = world.addMaterial({"white", 1.0});
    world.add(world::WorldSegment{{{rho, 3.0}, {rho, -3.0}}, 0.0, 2.0, white});
    const Eigen::Isometry3d T_map_mount(Eigen::Translation3d(0.0, 0.0, 1.0));
    const double start = rate_ > 0.0 ? -0.5 : 0.5;
    sensor.command({motion::HeadCommand::Mode::kPosition, start, 0.0});
    sensor.advance(world, 1'000'000'000, [&](std::int64_t) { return T_map_mount; });
    sensor.command({motion::HeadCommand::Mode::kRate, 0.0, rate_});
    const auto scans = sensor.advance(world, 1'000'000'000 + std::llround(1e9 / std::abs(rate_)),
                                      [&](std::int64_t) { return T_map_mount; });
    for (const auto& raw : scans) judge(ranger.range(raw), rho, random);
  }

  void printFigures(const std::string& name) const {
    print(name + ".rho_rmse_ratio", std::sqrt(rho_ / exact_rho_), "1");
    print(name + ".phi_rmse_ratio", std::sqrt(phi_ / exact_phi_), "1");
    print(name + ".in_gate", 100.0 * inside_ / lines_, "%");
    std::printf("# %s: %.0f lines\n", name.c_str(), lines_);
  }

 private:
  void judge(const motion::RangeScan& exact, double rho, std::mt19937_64& random) {
    motion::RangeScan coarse = exact;
    coarsenHead(coarse, random);
    coarse.scan.setSensorMotion(motion::headMotion(coarse.head));
    const double step = geometry::radians(0.36);
    coarse.scan.motion_noise.jitter = step * step * (0.25 + 1.0 / 12.0);
    coarse.scan.motion_noise.jitter_axis = coarse.head.T_mount_sensor(0).inverse().translation();
    const auto found = wallIn(coarse);
    const auto reference = wallIn(exact);
    if (!found || !reference) return;
    const geometry::PolarLine truth{rho, 0.0, {}};
    const Eigen::Vector2d error = geometry::difference(*found, truth);
    const Eigen::Vector2d exact_error = geometry::difference(*reference, truth);
    rho_ += error.x() * error.x();
    phi_ += error.y() * error.y();
    exact_rho_ += exact_error.x() * exact_error.x();
    exact_phi_ += exact_error.y() * exact_error.y();
    const double nees = error.dot(found->covariance.ldlt().solve(error));
    inside_ += nees < geometry::kChiSquare95Of2 ? 1.0 : 0.0;
    lines_ += 1.0;
  }
  // In the mount's frame. With exact angles this is the fit by maximum likelihood.
  std::optional<geometry::PolarLine> wallIn(const motion::RangeScan& scan) {
    const auto& segments = extractor_.extract(scan.scan);
    if (segments.size() != 1) return std::nullopt;
    return geometry::transform(scan.head.T_mount_sensor(0), segments[0].line);
  }

  double rate_;
  simulation::ActiveSensorProfile profile_;
  lines::LineExtractor extractor_;
  double rho_ = 0.0, phi_ = 0.0, exact_rho_ = 0.0, exact_phi_ = 0.0;
  double inside_ = 0.0, lines_ = 0.0;
};

inline void turningHead(std::uint64_t seeds) {
  for (const int degrees : {45, 90, 180}) {
    for (const double sense : {1.0, -1.0}) {
      // The faster the head, the fewer scans it takes of the wall.
      const auto runs = static_cast<std::uint64_t>(degrees / 45);
      HeadFigures figures(sense * geometry::radians(degrees));
      for (std::uint64_t seed = 1; seed <= seeds * runs; ++seed) figures.run(seed);
      figures.printFigures("gaze.head_" + std::to_string(degrees) +
                           (sense > 0.0 ? "_left" : "_right"));
    }
  }
}

}  // namespace sightline::bench
