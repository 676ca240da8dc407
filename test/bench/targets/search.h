#pragma once

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/logs/ospa.h"
#include "sightline/targets/bernoulli_filter.h"
#include "sightline/targets/search.h"
#include "sightline/targets/simulated_team.h"

namespace sightline::bench {

/// A square in which a team searches; walls by `sight`.
struct SearchArena {
  std::string name;
  targets::TeamConfig team;
  std::shared_ptr<const targets::LineOfSight> sight;
};

inline SearchArena openArena() {
  return {"search", {}, nullptr};
}

/// 40 m by 40 m, nine rooms with an opening of 3 m in the middle of each wall between them.
inline SearchArena walledArena() {
  constexpr double kSize = 40.0;
  constexpr double kRoom = kSize / 3.0;
  world::World world;
  const auto add = [&](double x0, double y0, double x1, double y1) {
    world.add(world::WorldSegment{{{x0, y0}, {x1, y1}}, 0.0, 2.5, 0});
  };
  for (int wall = 0; wall <= 3; ++wall) {
    for (int room = 0; room < 3; ++room) {
      const double at = wall * kRoom;
      const double from = room * kRoom;
      const bool is_outer = wall == 0 || wall == 3;
      const double gap = is_outer ? 0.0 : 1.5;
      const double middle = from + 0.5 * kRoom;
      for (const auto& [a, b] : {std::pair(from, middle - gap), {middle + gap, from + kRoom}}) {
        add(at, a, at, b);
        add(a, at, b, at);
      }
    }
  }
  SearchArena arena;
  arena.name = "search_walls";
  arena.team.size = kSize;
  arena.sight = std::make_shared<targets::WorldSight>(std::move(world), 0.3);
  return arena;
}

/// Seconds until the team's filter is within 1 m OSPA of the truth, at most `limit`.
inline double timeToFind(const SearchArena& arena, targets::SearchGain gain, std::uint64_t seed,
                         int limit) {
  constexpr int kReplan = 3;
  constexpr double kFound = 1.0;
  targets::SimulatedTeam team(arena.team, 1000 + seed, arena.sight);
  const std::vector<double> area{0.0, 0.0, arena.team.size, arena.team.size};
  targets::BernoulliFilterConfig filter_config;
  filter_config.undetected.area = area;
  targets::BernoulliFilter filter(filter_config);
  targets::SearchConfig config;
  config.gain = gain;
  config.actions.area = config.undetected.area = area;
  config.seed = static_cast<int>(seed);
  targets::SensorModelsConfig models;
  models.common = arena.team.model;
  targets::Search search(config, models, arena.sight);
  const auto names = [](std::size_t robot) { return fmt::format("robot{}", robot + 1); };
  for (int second = 0; second <= limit; ++second) {
    std::vector<targets::Search::Robot> idle;
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < static_cast<std::size_t>(arena.team.robots); ++i) {
      // The law of the paper keeps to its ways, as random ones are kept to.
      const bool is_due = gain == targets::SearchGain::kDetections && second % kReplan == 0;
      if (second > 0 && !is_due && !team.hasArrived(i)) continue;
      idle.push_back({names(i), team.T_map_sensor(i)});
      indices.push_back(i);
    }
    search.setTargets(filter.estimate().targets);
    const auto choices = search.plan(idle);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (choices[i]) team.send(indices[i], choices[i]->action.poses.back().translation());
    }
    for (const auto& look : team.step()) {
      filter.update(look.set, team.model());
      search.look(names(look.set.robot), look.set);
    }
    logs::Points places;
    for (const auto& target : filter.estimate().targets) places.push_back(target.mean);
    if (logs::ospa(team.targets(), places) <= kFound) return second;
  }
  return limit;
}

/// Time to find the targets by each rule, over that of random ways from the same set.
inline void measureSearch(int seeds) {
  using targets::SearchGain;
  for (const SearchArena& arena : {openArena(), walledArena()}) {
    const int limit = arena.sight ? 1800 : 900;
    double times[3] = {};
    for (const auto gain :
         {SearchGain::kDetections, SearchGain::kInformation, SearchGain::kRandom}) {
      for (int seed = 0; seed < seeds; ++seed) {
        times[static_cast<std::size_t>(gain)] +=
            timeToFind(arena, gain, static_cast<std::uint64_t>(seed), limit) / seeds;
      }
    }
    const std::string name = "targets." + arena.name;
    fmt::print("# {}: {:.0f} s by detections, {:.0f} s by information, {:.0f} s at random\n",
               arena.name, times[0], times[1], times[2]);
    print(name + ".time_ratio", times[0] / times[2], "1");
    print(name + ".information_time_ratio", times[1] / times[2], "1");
  }
}

}  // namespace sightline::bench
