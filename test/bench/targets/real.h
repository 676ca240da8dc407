#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/targets/target_log.h"
#include "temporary_folder.h"

namespace sightline::bench {

/// The programs that a user runs, on a set of the UTIAS multi-robot data.
class RealTeam {
 public:
  /// Characterises the sensors, and once more without the lag of their stamps.
  explicit RealTeam(std::string data) : data_(std::move(data)) {
    write("clean.yaml", "");
    characterize();
    lag_ = fmt::format("--lag {:.4f}", 1e-3 * meanLag());
    characterize();
  }

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
    targets::TargetScore early;  // 60 to 300 s
    targets::TargetScore late;   // 300 s to the end
  };
  /// Errors that are added to poses, and settings of the group `targets` besides the models.
  Scores track(int seed, const std::string& pose_errors, const std::string& settings) {
    convert("run.bag", fmt::format("--seed {} {}", seed, pose_errors));
    write("run.yaml", "  models: models/sensor_models.yaml\n" + settings);
    run(fmt::format("offline --config {} --nodes targets --out {} {}", folder_.path("run.yaml"),
                    folder_.path("out"), folder_.path("run.bag")),
        "offline.txt");
    const auto estimates = targets::readTargetLog(folder_.path("out/targets.csv"));
    const auto truth = targets::readTargetTruth(folder_.path("run.bag.truth.csv"));
    return {targets::score(estimates, truth, {}, {60.0, 300.0}, 10.0),
            targets::score(estimates, truth, {}, {300.0, 1e9}, 10.0)};
  }

 private:
  void characterize() const {
    convert("clean.bag", "");
    run(fmt::format("characterize_bearing_sensor --config {} --targets {} --out {} {}",
                    folder_.path("clean.yaml"), folder_.path("clean.bag.truth.csv"),
                    folder_.path("models"), folder_.path("clean.bag")),
        "characterization.txt");
  }
  // Mean over robots, as the report says it [ms].
  double meanLag() const {
    std::ifstream file(folder_.path("characterization.txt"));
    double sum = 0.0;
    double count = 0.0;
    for (std::string line; std::getline(file, line);) {
      const auto at = line.find("lag ");
      if (at == std::string::npos) continue;
      sum += std::stod(line.substr(at + 4));
      count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
  }
  void run(const std::string& command, const std::string& log) const {
    const std::string line =
        fmt::format("{}/{} > {} 2>&1", SIGHTLINE_PROGRAMS, command, folder_.path(log));
    if (std::system(line.c_str()) != 0) throw std::runtime_error("failed: " + line);
  }
  void convert(const std::string& name, const std::string& options) const {
    run(fmt::format("mrclam_to_bag {} {} {} {}", data_, folder_.path(name), lag_, options),
        "convert.txt");
  }
  void write(const std::string& name, const std::string& settings) const {
    folder_.write(name,
                  "targets:\n  robots: [robot1, robot2, robot3, robot4, robot5]\n"
                  "  period: 1.0\n" +
                      settings);
  }

  std::string data_;
  std::string lag_;
  test::TemporaryFolder folder_;
};

inline void measureReal(const std::string& data, int runs) {
  const std::string jitter = "--position-sigma 0.001 --heading-sigma 0.02";
  RealTeam team(data);
  int refused =
      std::min(1, team.linesWith("d_t: undetermined") + team.linesWith("eq. 1 is refused"));
  refused += team.linesWith("theta_c: undetermined") + team.linesWith("p_u: undetermined");
  print("targets.real.refused", refused, "of 3");
  double early = 0.0, late = 0.0, number = 0.0, movers = 0.0, offset = 0.0, nees = 0.0;
  for (int seed = 1; seed <= runs; ++seed) {
    const auto plain = team.track(seed, jitter, "");
    early += plain.early.ospa / runs;
    late += plain.late.ospa / runs;
    number += plain.late.number_error / runs;
    nees += plain.late.nees / runs;
    movers += team.track(seed, jitter, "  explain_mates: false\n  bernoulli: {moving_share: 0.3}\n")
                  .late.ospa /
              runs;
    offset += team.track(seed, "--position-sigma 0.05 --heading-sigma 1 --pose-correlation 20", "")
                  .late.ospa /
              runs;
  }
  print("targets.real.ospa_mean_60_300", early, "m");
  print("targets.real.ospa_mean_300_end", late, "m");
  print("targets.real.number_error_300_end", number, "targets");
  print("targets.real.nees_300_end", nees, "1");
  print("targets.real.unknown_movers_300_end", movers, "m");
  print("targets.real.offset_300_end", offset, "m");
}

}  // namespace sightline::bench
