#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "sightline/simulation/simulation.h"

namespace sightline::test {

/// A scanner of the whole circle, at once and nearly without noise.
inline simulation::ScannerProfile allRound() {
  simulation::ScannerProfile profile;
  profile.beams = 361;
  profile.angle_min = -geometry::kPi;
  profile.angle_max = geometry::kPi;
  profile.revolution = 0.0;
  profile.resolution = 0.0;
  profile.noise.sigma = 1e-6;  // the least that there is
  profile.noise.kind = scan::NoiseKind::kConstant;
  return profile;
}

/// A path to one place [m] at a speed [m/s].
inline simulation::Path straight(const Eigen::Vector2d& to, double speed) {
  simulation::Path path;
  path.speed = speed;
  path.waypoints_map = {to};
  return path;
}

/// Nearest range of a sweep [m], and the bearing that it has [rad].
inline std::pair<double, double> nearestOf(const scan::Scan& scan) {
  const auto nearest = std::min_element(scan.ranges().begin(), scan.ranges().end());
  const auto beam = static_cast<std::size_t>(nearest - scan.ranges().begin());
  return {*nearest, scan.geometry()->angles()[beam]};
}

/// Latest sweep of each robot, by the robot's index.
inline std::vector<scan::Scan> lastSweeps(simulation::Simulation& simulation, double seconds) {
  std::vector<std::optional<scan::Scan>> last(simulation.robots());
  const auto end = simulation.time() + std::llround(1e9 * seconds);
  while (simulation.time() < end) {
    for (auto& sweep : simulation.step().sweeps) last[sweep.robot] = std::move(sweep.scan);
  }
  std::vector<scan::Scan> result;
  for (auto& scan : last) result.push_back(std::move(scan.value()));
  return result;
}

}  // namespace sightline::test
