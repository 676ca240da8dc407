// Figures of dead reckoning by scans, one a line: `name value unit`; lines that start with #
// explain. What each figure means is said in the headers under odometry/. With --plots DIR, the
// pictures of odometry/plots.h come first.
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "odometry/at_rest.h"
#include "odometry/body_worn.h"
#include "odometry/consistency.h"
#include "odometry/long_way.h"
#include "odometry/node.h"
#include "odometry/plots.h"
#include "odometry/recordings.h"
#include "odometry/searcher.h"

namespace {

using namespace sightline;

void measureData(const std::filesystem::path& folder) {
  const auto in = [&](const char* name) { return (folder / name).string(); };
  // The relations hold 4 cm ahead of the point that scans and odometry share.
  const bench::Recording freiburg{"fr079",
                                  bench::ScanLog(in("fr079.clf.gz"), true),
                                  logs::readRelations(in("fr079.relations")),
                                  {0.04, 0.0, 0.0}};
  std::optional<bench::Recording> intel;
  if (std::filesystem::exists(folder / "intel_part.clf.gz")) {
    intel.emplace(bench::Recording{"intel_part",
                                   bench::ScanLog(in("intel_part.clf.gz"), false),
                                   logs::readRelations(in("intel_part.relations")),
                                   {}});
  }
  bench::measureRecordings(freiburg, intel ? &*intel : nullptr);
  bench::measureSearcher(freiburg.log);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--plots") bench::ThesisPlots(argv[2]).draw();
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = data ? data : "";
  if (data && std::filesystem::exists(folder / "fr079.clf.gz")) {
    measureData(folder);
  } else {
    fmt::print("# odometry.fr079: left out, SIGHTLINE_DATA holds no fr079.clf.gz\n");
  }
  bench::measureAtRest();
  bench::measureConsistency();
  bench::measureLongWays();
  bench::measureBodyWorn();
  bench::measureOdometryNode();
  return 0;
}
