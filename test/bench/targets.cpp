// Figures of bearing-only targets, one a line: `name value unit`; lines that start with # explain.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "targets/fit.h"
#include "targets/real.h"
#include "targets/team.h"

int main() {
  using namespace sightline;
  constexpr int kSeeds = 20;
  bench::measureClutter();
  bench::measureTeams(kSeeds);
  bench::measureFits(kSeeds);
  bench::measureWrongModels(4);
  bench::measureScale(3);
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = std::filesystem::path(data ? data : "") / "mrclam6";
  if (data && std::filesystem::exists(folder)) {
    bench::measureReal(folder.string());
  } else {
    fmt::print("# targets.real: left out, SIGHTLINE_DATA holds no mrclam6\n");
  }
  return 0;
}
