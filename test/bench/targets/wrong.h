#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/plot/figure.h"
#include "targets/team.h"

namespace sightline::bench {

/// A parameter of the sensor model, times a factor.
struct WrongModel {
  const char* name;
  std::function<void(targets::SensorModelConfig&, double)> change;
};

inline std::vector<WrongModel> wrongModels() {
  return {{"p_d",
           [](auto& model, double factor) {
             auto& detection = model.detection;
             detection.false_negative =
                 std::max(0.0, 1.0 - factor * (1.0 - detection.false_negative));
           }},
          {"sigma", [](auto& model, double factor) { model.bearing.sigma *= factor; }},
          {"mu", [](auto& model, double factor) { model.clutter.mean *= factor; }}};
}

/// Bias of the number of targets by both filters.
struct NumberBias {
  double bernoulli;
  double phd;
};

inline NumberBias measureWrong(const std::string& name, const targets::TeamConfig& team,
                               const targets::SensorModelConfig& told, int seeds) {
  const TeamFigures bernoulli = runTeam(team, defaultFilter(), seeds, &told);
  const TeamFigures phd = runTeam(team, papersFilter(), seeds, &told);
  print("targets.wrong." + name + ".ospa_600s", bernoulli.ospa[2], "m");
  print("targets.wrong." + name + ".number_bias", bernoulli.number_bias, "targets");
  print("targets.wrong." + name + ".phd_ospa_600s", phd.ospa[2], "m");
  print("targets.wrong." + name + ".phd_mass_bias", phd.mass_bias, "targets");
  return {bernoulli.number_bias, phd.mass_bias};
}

/// Section 3.4 of dames: what a wrong model does to the number of targets; drawn at `path`.
inline void measureWrongModels(int seeds, const std::string& path) {
  const targets::TeamConfig team;
  plot::Panel panels[2] = {
      {"Default filter", "factor on the parameter", "bias of the number of targets", "", 0.0, {}},
      {"PHD", "factor on the parameter", "bias of its mass", "", 0.0, {}}};
  const NumberBias right = measureWrong("none", team, team.model, seeds);
  for (const WrongModel& wrong : wrongModels()) {
    plot::Series series[2];
    for (plot::Series& one : series) one = {wrong.name, plot::Style::kLineAndPoints, {}};
    for (const double factor : {0.5, 1.0, 1.5}) {
      targets::SensorModelConfig told = team.model;
      wrong.change(told, factor);
      const NumberBias bias =
          factor == 1.0
              ? right
              : measureWrong(fmt::format("{}_x{}", wrong.name, factor), team, told, seeds);
      series[0].points.push_back({factor, bias.bernoulli});
      series[1].points.push_back({factor, bias.phd});
    }
    for (int i = 0; i < 2; ++i) panels[i].series.push_back(series[i]);
  }
  targets::SensorModelConfig flat = team.model;
  flat.detection.false_negative = 0.2;
  flat.detection.target_diameter = 10.0;
  flat.detection.range_max = 15.0;
  measureWrong("flat", team, flat, seeds);
  plot::writePng({1200, 500, 2, {panels[0], panels[1]}}, path);
  fmt::print("# the biases of the number are drawn in {}\n", path);
}

}  // namespace sightline::bench
