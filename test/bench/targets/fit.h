#pragma once

#include <cmath>
#include <vector>

#include "figures.h"
#include "sightline/targets/characterization.h"
#include "sightline/targets/simulated_team.h"

namespace sightline::bench {

/// 1959 looks of the paper's team, poses exact.
inline std::vector<targets::KnownLook> knownLooks(targets::SimulatedTeam& team) {
  constexpr std::size_t kLooks = 1959;
  std::vector<targets::KnownLook> looks;
  while (looks.size() < kLooks) {
    for (const auto& simulated : team.step()) {
      targets::KnownLook look;
      look.robot = simulated.set.robot;
      look.stamp = simulated.set.stamp;
      look.T_map_sensor = simulated.T_map_sensor;
      look.bearings = simulated.set.bearings;
      looks.push_back(look);
    }
  }
  looks.resize(kLooks);
  return looks;
}

inline targets::Characterization characterizeTeam(const targets::TeamConfig& config,
                                                  std::uint64_t seed) {
  targets::SimulatedTeam team(config, seed);
  targets::CharacterizationConfig settings;
  settings.field_of_view = config.model.field_of_view;
  settings.range_max = config.model.detection.range_max;
  settings.beam_spacing = config.model.detection.beam_spacing;
  const auto looks = knownLooks(team);
  return targets::characterize(looks, {"robot1", "robot2", "robot3"}, team.targets(), settings);
}

/// Recovery of the paper's values from simulated sets of the paper's size.
inline void measureFits(int seeds) {
  constexpr double kInch = 0.0254;
  const targets::TeamConfig team;
  double p_fn = 0.0, diameter = 0.0, width = 0.0, share = 0.0, mean = 0.0, sigma = 0.0;
  int undetermined = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto found = characterizeTeam(team, 1 + static_cast<std::uint64_t>(seed));
    p_fn += std::abs(found.detection.false_negative.value - 0.21) / seeds;
    diameter += std::abs(found.detection.target_diameter.value / kInch - 1.28) / seeds;
    width += std::abs(found.clutter.peak_width.value / geometry::kPi - 0.2) / seeds;
    share += std::abs(found.clutter.uniform_share.value - 0.725) / seeds;
    mean += std::abs(found.clutter.mean.value - 0.5319) / seeds;
    double of_robots = 0.0;
    for (const auto& [name, robot] : found.robots) of_robots += robot.errors.sigma;
    of_robots /= static_cast<double>(found.robots.size());
    sigma += std::abs(geometry::degrees(of_robots) - 2.25) / seeds;
    targets::TeamConfig fine = team;
    fine.model.detection.beam_spacing = geometry::radians(0.25);
    const auto of_fine = characterizeTeam(fine, 101 + static_cast<std::uint64_t>(seed));
    if (!of_fine.detection.target_diameter.is_determined) ++undetermined;
  }
  print("targets.fit.p_fn_error", p_fn, "1");
  print("targets.fit.d_t_in_error", diameter, "in");
  print("targets.fit.theta_c_pi_error", width, "pi rad");
  print("targets.fit.p_u_error", share, "1");
  print("targets.fit.mu_error", mean, "1");
  print("targets.fit.sigma_deg_error", sigma, "deg");
  std::printf("# of %d sets with a beam spacing of 0.25 deg\n", seeds);
  print("targets.fit.reports_undetermined", undetermined, "sets");
}

}  // namespace sightline::bench
