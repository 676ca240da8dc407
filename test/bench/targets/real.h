#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/logs/mrclam.h"
#include "sightline/targets/target_log.h"
#include "targets/real_tracker.h"
#include "temporary_folder.h"

namespace sightline::bench {

/// The programs that a user runs, on a set of the UTIAS multi-robot data.
class RealTeam {
 public:
  /// Characterises the sensors on a part of the set and tracks on a part: options of mrclam_to_bag,
  /// none: all of it.
  explicit RealTeam(std::string data, const std::string& fitted = "", std::string tracked = "")
      : data_(std::move(data)), tracked_(std::move(tracked)) {
    write("clean.yaml", "");
    convert("clean.bag", fitted);
    run(fmt::format("characterize_bearing_sensor --config {} --targets {} --out {} {}",
                    folder_.path("clean.yaml"), folder_.path("clean.bag.truth.csv"),
                    folder_.path("models"), folder_.path("clean.bag")),
        "characterization.txt");
  }

  std::string models() const { return folder_.path("models/sensor_models.yaml"); }

  /// Lines of the report of the characterisation that hold a text.
  int linesWith(const std::string& text) const {
    std::ifstream file(folder_.path("characterization.txt"));
    int count = 0;
    for (std::string line; std::getline(file, line);) {
      if (line.find(text) != std::string::npos) ++count;
    }
    return count;
  }

  struct Scores {
    targets::TargetScore early;  // 60 s to the middle
    targets::TargetScore late;   // from there to the end
  };
  /// Errors that are added to poses, and settings of the group `targets` besides the models.
  Scores track(int seed, const std::string& pose_errors, const std::string& settings,
               double middle = 300.0) {
    convert("run.bag", fmt::format("{} --seed {} {}", tracked_, seed, pose_errors));
    write("run.yaml", "  models: models/sensor_models.yaml\n" + settings);
    run(fmt::format("offline --config {} --nodes targets --out {} {}", folder_.path("run.yaml"),
                    folder_.path("out"), folder_.path("run.bag")),
        "offline.txt");
    const auto estimates = targets::readTargetLog(folder_.path("out/targets.csv"));
    const auto truth = targets::readTargetTruth(folder_.path("run.bag.truth.csv"));
    return {targets::score(estimates, truth, {}, {60.0, middle}, 10.0),
            targets::score(estimates, truth, {}, {middle, 1e9}, 10.0)};
  }

 private:
  void run(const std::string& command, const std::string& log) const {
    const std::string line =
        fmt::format("{}/{} > {} 2>&1", SIGHTLINE_PROGRAMS, command, folder_.path(log));
    if (std::system(line.c_str()) != 0) throw std::runtime_error("failed: " + line);
  }
  void convert(const std::string& name, const std::string& options) const {
    run(fmt::format("mrclam_to_bag {} {} {}", data_, folder_.path(name), options), "convert.txt");
  }
  void write(const std::string& name, const std::string& settings) const {
    folder_.write(name,
                  "targets:\n  robots: [robot1, robot2, robot3, robot4, robot5]\n"
                  "  period: 1.0\n" +
                      settings);
  }

  std::string data_;
  std::string tracked_;
  test::TemporaryFolder folder_;
};

/// Sums of figures over runs.
struct RealFigures {
  static constexpr const char* kJitter = "--position-sigma 0.001 --heading-sigma 0.02";

  double early = 0.0;
  double late = 0.0;
  double number = 0.0;
  double nees = 0.0;
  double inside = 0.0;
  double movers = 0.0;
  double offset = 0.0;

  void add(RealTeam& team, int seed, double middle = 300.0) {
    const std::string off = "--position-sigma 0.05 --heading-sigma 1 --pose-correlation 20";
    const auto plain = team.track(seed, kJitter, "", middle);
    early += plain.early.ospa;
    late += plain.late.ospa;
    number += plain.late.number_error;
    nees += plain.late.nees;
    inside += plain.late.inside;
    const std::string unknown = "  explain_mates: false\n  bernoulli: {moving_share: 0.3}\n";
    movers += team.track(seed, kJitter, unknown, middle).late.ospa;
    offset += team.track(seed, off, "", middle).late.ospa;
  }
  void show(const std::string& name, const std::string& late_span, double runs) const {
    print(name + ".ospa_mean_" + late_span, late / runs, "m");
    print(name + ".number_error_" + late_span, number / runs, "targets");
    print(name + ".nees_" + late_span, nees / runs, "of_2");
    print(name + ".inside_95_" + late_span, 100.0 * inside / runs, "%");
    print(name + ".unknown_movers_" + late_span, movers / runs, "m");
    print(name + ".offset_" + late_span, offset / runs, "m");
  }
};

inline void measureReal(const std::string& data, int runs) {
  RealTeam team(data);
  int refused =
      std::min(1, team.linesWith("d_t: undetermined") + team.linesWith("eq. 1 is refused"));
  refused += team.linesWith("theta_c: undetermined") + team.linesWith("p_u: undetermined");
  print("targets.real.refused", refused, "of 3");
  RealFigures figures;
  for (int seed = 1; seed <= runs; ++seed) figures.add(team, seed);
  print("targets.real.ospa_mean_60_300", figures.early / runs, "m");
  figures.show("targets.real", "300_end", runs);
  measureRealTracker(data, team.models());
}

/// Time from the first look of any robot to the last one [s].
inline double durationOf(const logs::MrclamSet& set) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = 0;
  for (const logs::MrclamRobot& robot : set.robots) {
    if (robot.looks.empty()) continue;
    first = std::min(first, robot.looks.front().stamp);
    last = std::max(last, robot.looks.back().stamp);
  }
  return 1e-9 * static_cast<double>(last - first);
}

/// Models that are fitted on one half of a set and judged on the other, and back.
inline void measureRealHalves(const std::string& data, int runs) {
  const double half = 0.5 * durationOf(logs::readMrclam(data));
  const std::string first = fmt::format("--to {:.3f}", half);
  const std::string second = fmt::format("--from {:.3f}", half);
  RealTeam on_second(data, first, second);
  RealTeam on_first(data, second, first);
  RealTeam whole_on_second(data, "", second);
  RealTeam whole_on_first(data, "", first);
  double tuned = 0.0;
  RealFigures figures;
  for (int seed = 1; seed <= runs; ++seed) {
    figures.add(on_second, seed, 200.0);
    figures.add(on_first, seed, 200.0);
    tuned += whole_on_second.track(seed, RealFigures::kJitter, "", 200.0).late.ospa;
    tuned += whole_on_first.track(seed, RealFigures::kJitter, "", 200.0).late.ospa;
  }
  figures.show("targets.real.other_half", "200_end", 2.0 * runs);
  fmt::print("# models of the whole set on the same halves: {:.3f} m\n", tuned / (2.0 * runs));
  print("targets.real.other_half.ospa_ratio", figures.late / tuned, "1");
}

}  // namespace sightline::bench
