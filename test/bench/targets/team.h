#pragma once

#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/logs/ospa.h"
#include "sightline/targets/bernoulli_filter.h"
#include "sightline/targets/oracle.h"
#include "sightline/targets/phd_filter.h"
#include "sightline/targets/simulated_team.h"
#include "sightline/targets/target_log.h"

namespace sightline::bench {

using FilterMaker = std::function<std::unique_ptr<targets::TargetFilter>()>;

inline FilterMaker defaultFilter(double size = 20.0) {
  return [size] {
    targets::BernoulliFilterConfig config;
    config.undetected.area = {0.0, 0.0, size, size};
    return std::make_unique<targets::BernoulliFilter>(config);
  };
}

inline FilterMaker papersFilter() {
  return [] {
    targets::PhdFilterConfig config;
    config.undetected.area = {0.0, 0.0, 20.0, 20.0};
    return std::make_unique<targets::PhdFilter>(config);
  };
}

/// Means over seeds at 60, 300 and 600 s.
struct TeamFigures {
  double ospa[3] = {};
  double oracle[3] = {};
  double number_error = 0.0;  // reported less true, absolute, at 600 s
  double number_bias = 0.0;   // signed
  double mass_error = 0.0;    // expected less true, absolute
  double mass_bias = 0.0;
  double us_per_set = 0.0;
  double particles_per_s = 0.0;  // of a filter that has some
};

/// `told` is the model that the filter is given; the team's own where there is none.
inline TeamFigures runTeam(const targets::TeamConfig& config, const FilterMaker& make, int seeds,
                           const targets::SensorModelConfig* told = nullptr, int seconds = 600) {
  constexpr int kMoments[] = {60, 300, 600};
  TeamFigures figures;
  double busy = 0.0;
  double sets = 0.0;
  double updates = 0.0;
  const targets::SensorModel model(told ? *told : config.model);
  for (int seed = 0; seed < seeds; ++seed) {
    targets::SimulatedTeam team(config, 1000 + static_cast<std::uint64_t>(seed));
    const auto filter = make();
    targets::Oracle oracle;
    for (int second = 0; second <= seconds; ++second) {
      const auto looks = team.step();
      const std::clock_t began = std::clock();  // of this process: others run beside it
      for (const auto& look : looks) filter->update(look.set, model);
      busy += static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
      sets += static_cast<double>(looks.size());
      for (const auto& look : looks) oracle.update(look.set, team.model(), look.origins);
      for (int i = 0; i < 3; ++i) {
        if (second != kMoments[i]) continue;
        const auto estimate = filter->estimate();
        logs::Points places;
        for (const auto& target : estimate.targets) places.push_back(target.mean);
        figures.ospa[i] += logs::ospa(team.targets(), places) / seeds;
        figures.oracle[i] += logs::ospa(team.targets(), oracle.estimate()) / seeds;
        if (i < 2) continue;
        const double bias = static_cast<double>(places.size()) - config.targets;
        const double mass = estimate.expected_number - config.targets;
        figures.number_bias += bias / seeds;
        figures.number_error += std::abs(bias) / seeds;
        figures.mass_bias += mass / seeds;
        figures.mass_error += std::abs(mass) / seeds;
      }
    }
    const auto* phd = dynamic_cast<const targets::PhdFilter*>(filter.get());
    if (phd != nullptr) updates += static_cast<double>(phd->updates());
  }
  figures.us_per_set = 1e6 * busy / sets;
  figures.particles_per_s = updates / busy;
  return figures;
}

inline void printTeam(const std::string& name, const TeamFigures& figures) {
  fmt::print("# {}: oracle {:.3f}, {:.3f}, {:.3f} m at 60, 300, 600 s\n", name, figures.oracle[0],
             figures.oracle[1], figures.oracle[2]);
  print(name + ".ospa_60s_excess", figures.ospa[0] - figures.oracle[0], "m");
  print(name + ".ospa_300s", figures.ospa[1], "m");
  print(name + ".ospa_600s", figures.ospa[2], "m");
  print(name + ".cardinality_error_600s", figures.number_error, "targets");
  print(name + ".mass_error_600s", figures.mass_error, "targets");
}

inline void measureTeams(int seeds) {
  targets::TeamConfig team;
  const TeamFigures plain = runTeam(team, defaultFilter(), seeds);
  printTeam("targets.team", plain);
  print("targets.us_per_set", plain.us_per_set, "us");
  targets::TeamConfig off = team;
  off.position_sigma = 0.05;
  off.heading_sigma = geometry::radians(1.0);
  printTeam("targets.team_offset", runTeam(off, defaultFilter(), seeds));
  targets::TeamConfig correlated = team;
  correlated.model.visibility = {0.95, 20.0};
  printTeam("targets.team_correlated", runTeam(correlated, defaultFilter(), seeds));
  targets::SensorModelConfig untold = correlated.model;
  untold.visibility = {};
  printTeam("targets.team_correlated_untold", runTeam(correlated, defaultFilter(), seeds, &untold));
  const TeamFigures phd = runTeam(team, papersFilter(), seeds);
  printTeam("targets.team_phd", phd);
  print("targets.team_phd.us_per_set", phd.us_per_set, "us");
  print("targets.team_phd.particles_per_s", phd.particles_per_s, "1/s");
}

/// Whether the covariances of the reported targets hold, from 300 to 600 s.
inline void measureConsistency(const std::string& name, const targets::TeamConfig& config,
                               int seeds) {
  double nees = 0.0;
  double inside = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    targets::SimulatedTeam team(config, 2000 + static_cast<std::uint64_t>(seed));
    const auto filter = defaultFilter()();
    std::vector<targets::TargetEstimate> estimates;
    for (int second = 0; second <= 600; ++second) {
      for (const auto& look : team.step()) filter->update(look.set, team.model());
      estimates.push_back(filter->estimate());
    }
    const auto score = targets::score(estimates, team.targets(), {}, {300.0, 600.0}, 10.0);
    nees += score.nees / seeds;
    inside += score.inside / seeds;
  }
  print("targets.consistency." + name + ".nees", nees, "of_2");
  print("targets.consistency." + name + ".inside_95", 100.0 * inside, "%");
}

/// With errors of each bearing by itself, with poses that are off for 5 to 60 s in a row, which the
/// filter is not told, and with sensors whose errors are those of the cameras of the real set.
inline void measureConsistencies(int seeds) {
  measureConsistency("plain", {}, seeds);
  for (const double duration : {5.0, 20.0, 60.0}) {
    targets::TeamConfig off;
    off.position_sigma = 0.05;
    off.heading_sigma = geometry::radians(1.0);
    off.pose_correlation = duration;
    measureConsistency(fmt::format("offset_{:.0f}s", duration), off, seeds);
  }
  targets::TeamConfig lasting;
  lasting.model.bearing.common_share = 0.5;
  lasting.model.bearing.lasting_share = 0.3;
  measureConsistency("lasting", lasting, seeds);
  printTeam("targets.team_lasting", runTeam(lasting, defaultFilter(), seeds));
}

inline void measureClutter() {
  constexpr int kScans = 2000000;
  const targets::SensorModel model;
  targets::BearingSampler sampler(model, 1);
  double count = 0.0;
  double in_peaks = 0.0;
  for (int i = 0; i < kScans; ++i) {
    const int drawn = sampler.clutterCount();
    count += drawn;
    for (int j = 0; j < drawn; ++j) {
      const double off = std::abs(std::abs(sampler.clutterBearing()) - 0.5 * geometry::kPi);
      if (off <= 0.5 * model.config().clutter.peak_width) in_peaks += 1.0;
    }
  }
  print("targets.clutter_mean_ratio", count / kScans / model.clutterMean(), "1");
  print("targets.clutter_in_peaks", 100.0 * in_peaks / count, "%");
}

}  // namespace sightline::bench
