// Figures of the room tracker, one a line: `name value unit`; lines that start with # explain.
//
// rooms.two_rooms.<scenario>.*: two rooms of 8x6 and 5x6 m joined by a door of 0.9 m, 120 s at 0.4
// m/s, 361 beams over 180° at 10 Hz to 8 m with 1 cm of noise, odometry 2 % short with drift on
// top. Everything is as shipped but for clean_told_exact, whose tracker is told that the map is
// exact; RMSE, NEES and shares are means over 20 seeds from 5 s on, maxima and times of the worst
// seed. clean_plain, utm30lx (the profile of that name), fixed and turret (360° in 0.1 s, standing
// on the robot and turning by 90°/s): 10 seeds, the tracker being told the true noise and that the
// map is exact. rooms.bootstrap.*: starts without a pose on the shipped floor. rooms.fr079.*: the
// Freiburg log against its hand-verified relations, on a map that was drawn over the scans of the
// same log; _raw: with its wheels as they were logged; _no_start: without a start pose;
// _laser_only: without wheels, by the dead reckoning from the scans.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "rooms/floor_starts.h"
#include "rooms/freiburg.h"
#include "rooms/limits.h"
#include "rooms/node.h"
#include "rooms/paper_runs.h"
#include "rooms/scenarios.h"
#include "sightline/geometry/statistics.h"
#include "two_rooms.h"

namespace {

using namespace sightline;
using test::PoseSample;
using test::TwoRoomsScenario;

constexpr int kRuns = 10;

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print(const std::string& name, const std::vector<PoseSample>& samples) {
  std::vector<double> position;
  std::vector<double> nees;
  std::vector<double> time;
  double square = 0.0;
  double heading = 0.0;
  double nees_sum = 0.0;
  double inside = 0.0;
  for (const PoseSample& sample : samples) {
    position.push_back(sample.position_error);
    time.push_back(sample.microseconds);
    square += sample.position_error * sample.position_error;
    heading += sample.heading_error * sample.heading_error;
    nees_sum += sample.nees;
    inside += sample.nees <= geometry::kChiSquare95Of3 ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(samples.size());
  fmt::print("{}.rmse {:.4f} m\n", name, std::sqrt(square / count));
  fmt::print("{}.max {:.4f} m\n", name, quantile(position, 1.0));
  fmt::print("{}.heading_rmse {:.3f} deg\n", name, geometry::degrees(std::sqrt(heading / count)));
  fmt::print("{}.nees {:.2f} 1\n", name, nees_sum / count);
  fmt::print("{}.in_gate {:.1f} %\n", name, 100.0 * inside / count);
  fmt::print("{}.us_median {:.1f} us\n", name, quantile(time, 0.5));
  fmt::print("{}.us_p99 {:.1f} us\n", name, quantile(time, 0.99));
}

void benchmark(const TwoRoomsScenario& scenario, const std::string& variant,
               const tracking::TrackerConfig& config,
               scan::NoiseKind noise = scan::NoiseKind::kConstant) {
  std::vector<PoseSample> samples;
  for (int run = 0; run < kRuns; ++run) {
    const auto seed = static_cast<std::uint64_t>(run + 1);
    const auto of_run = test::TwoRoomsDrive(scenario, seed, config, noise).samples();
    samples.insert(samples.end(), of_run.begin(), of_run.end());
  }
  print("rooms.two_rooms." + scenario.name + variant, samples);
}

void printTold(int) {
  const auto told = test::trackerConfig();
  auto plain = told;
  plain.method = tracking::Method::kPlain;
  benchmark({"clean"}, "_plain", plain);
  benchmark({"utm30lx", 0.0, 0.0, true}, "", told);
  benchmark({"fixed", 0.0, 0.0, false, true}, "", told);
  benchmark({"turret", 0.0, 0.0, false, true, geometry::radians(90.0)}, "", told);
}

struct Group {
  std::string name;
  int seeds;
  std::function<void(int)> print;
};

std::vector<Group> groups(const std::filesystem::path& folder) {
  return {
      {"told", kRuns, printTold},
      {"two_rooms", 20, bench::printTwoRooms},
      {"bootstrap", 100, bench::printFloorStarts},
      {"papers", 100, bench::printPaperRuns},
      {"limits", 100,
       [=](int seeds) { bench::printLimits(seeds, (folder / "rooms_limits.png").string()); }},
      {"node", 1, [](int) { bench::printNode(); }},
      {"fr079", 1, [](int) { bench::printFreiburg(); }},
  };
}

}  // namespace

// `bench_rooms [GROUP...] [--seeds N]`: all groups with the seeds of the figures, or some of them
// with fewer while something is being tried out.
int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  std::vector<std::string> wanted;
  std::optional<int> seeds;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--seeds" && i + 1 < argc) {
      seeds = std::stoi(argv[++i]);
    } else {
      wanted.push_back(argument);
    }
  }
  for (const Group& group : groups(std::filesystem::path(argv[0]).parent_path())) {
    const bool is_wanted =
        wanted.empty() || std::find(wanted.begin(), wanted.end(), group.name) != wanted.end();
    if (is_wanted) group.print(seeds.value_or(group.seeds));
  }
  return 0;
}
