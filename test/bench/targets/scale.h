#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/plot/figure.h"
#include "targets/team.h"

namespace sightline::bench {

/// Time a set over numbers of something, each printed.
inline plot::Panel measureGrowth(const std::string& what, const std::vector<int>& counts, int seeds,
                                 const std::function<void(targets::TeamConfig&, int)>& change) {
  constexpr int kSeconds = 300;
  plot::Series series{"", plot::Style::kLineAndPoints, {}};
  for (const int count : counts) {
    targets::TeamConfig team;
    change(team, count);
    const auto figures = runTeam(team, defaultFilter(team.size), seeds, nullptr, kSeconds);
    print(fmt::format("targets.scale.us_per_set_{}_{}", count, what), figures.us_per_set, "us");
    series.points.push_back({static_cast<double>(count), figures.us_per_set});
  }
  return {"Growth with " + what, what, "time a set [us]", "", 0.0, {series}};
}

/// Growth with targets, at the same density, and with robots; drawn at `path`.
inline void measureScale(int seeds, const std::string& path) {
  const auto by_targets =
      measureGrowth("targets", {5, 15, 50, 150}, seeds, [](targets::TeamConfig& team, int count) {
        team.targets = count;
        team.size = 20.0 * std::sqrt(count / 15.0);
      });
  const auto by_robots =
      measureGrowth("robots", {1, 3, 10, 30}, seeds,
                    [](targets::TeamConfig& team, int count) { team.robots = count; });
  plot::writePng({1200, 500, 2, {by_targets, by_robots}}, path);
  fmt::print("# time a set is drawn in {}\n", path);
}

}  // namespace sightline::bench
