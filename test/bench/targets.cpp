// Figures of bearing-only targets, one a line: `name value unit`; lines that start with # explain.
//
// usage: bench_targets [PART...], all by default; SIGHTLINE_BENCH_SEEDS=N takes N seeds at most.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "targets/detector.h"
#include "targets/fit.h"
#include "targets/node.h"
#include "targets/real.h"
#include "targets/real_sensor.h"
#include "targets/scale.h"
#include "targets/search.h"
#include "targets/team.h"
#include "targets/wrong.h"

namespace {

using namespace sightline;

// Seeds of everything, by SIGHTLINE_BENCH_SEEDS where it is set: fewer for a quick look.
int seedsOf(int usual) {
  const char* asked = std::getenv("SIGHTLINE_BENCH_SEEDS");
  return asked ? std::clamp(std::atoi(asked), 1, usual) : usual;
}

void measureRealTeam() {
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = std::filesystem::path(data ? data : "") / "mrclam6";
  if (data && std::filesystem::exists(folder)) {
    bench::measureRealSensors(folder.string());
    bench::measureReal(folder.string(), seedsOf(8));
    bench::measureRealHalves(folder.string(), seedsOf(4));
  } else {
    fmt::print("# targets.real: left out, SIGHTLINE_DATA holds no mrclam6\n");
  }
}

struct Part {
  const char* name;
  std::function<void()> measure;
};

}  // namespace

int main(int argc, char** argv) {
  const int seeds = seedsOf(20);
  const auto picture = [&](const char* name) {
    return std::filesystem::path(argv[0]).replace_filename(name).string();
  };
  const Part parts[] = {
      {"clutter", [] { bench::measureClutter(); }},
      {"detector", [&] { bench::measureDetector(seeds); }},
      {"places", [&] { bench::measurePlaces(seedsOf(2)); }},
      {"team", [&] { bench::measureTeams(seeds); }},
      {"consistency", [&] { bench::measureConsistencies(seeds); }},
      {"fit", [&] { bench::measureFits(seeds); }},
      {"search", [&] { bench::measureSearch(seeds); }},
      {"wrong", [&] { bench::measureWrongModels(seedsOf(4), picture("targets_wrong.png")); }},
      {"scale", [&] { bench::measureScale(seedsOf(3), picture("targets_scale.png")); }},
      {"node", [] { bench::measureTrackerNode(60.0); }},
      {"real", measureRealTeam},
  };
  for (const Part& part : parts) {
    const bool is_asked =
        argc < 2 || std::find(argv + 1, argv + argc, std::string(part.name)) != argv + argc;
    if (!is_asked) continue;
    fmt::print(stderr, "targets: {}\n", part.name);
    part.measure();
    std::fflush(stdout);
  }
  return 0;
}
