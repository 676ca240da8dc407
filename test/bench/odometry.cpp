// Figures of dead reckoning by scans, one a line: `name value unit`; lines that start with #
// explain. What each figure means is said in the headers under odometry/.
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "odometry/body_worn.h"
#include "odometry/consistency.h"
#include "odometry/freiburg.h"
#include "odometry/node.h"
#include "odometry/searcher.h"

int main() {
  using namespace sightline;
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = data ? data : "";
  if (data && std::filesystem::exists(folder / "fr079.clf.gz")) {
    const bench::ScanLog log((folder / "fr079.clf.gz").string());
    bench::measureFreiburg(log, logs::readRelations((folder / "fr079.relations").string()));
    bench::measureSearcher(log);
  } else {
    fmt::print("# odometry.fr079: left out, SIGHTLINE_DATA holds no fr079.clf.gz\n");
  }
  bench::measureConsistency();
  bench::measureBodyWorn();
  bench::measureOdometryNode();
  return 0;
}
