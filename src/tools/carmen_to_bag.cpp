// Turns a CARMEN log into a bag.
#include <cstdio>

#include "arguments.h"
#include "sightline/bridge/bag_from_carmen.h"

namespace {

using namespace sightline;

constexpr const char* kUsage =
    "carmen_to_bag IN.clf[.gz] OUT.bag [--reverse-from-tv] [--odometry-delay SECONDS]\n"
    "                     [--laser-offset METRES]\n"
    "  --reverse-from-tv   turn odometry steps round where the logged velocity is negative\n"
    "  --odometry-delay    stamp the odometry later by this\n"
    "  --laser-offset      how far the laser sits ahead of base_link\n";

// Whatever of the log does not get into the bag is said on standard error.
void printLosses(const logs::CarmenLog& log) {
  if (log.bad_lines > 0) {
    std::fprintf(stderr, "%s\n%zu lines that cannot be understood are left out\n",
                 log.first_fault.c_str(), log.bad_lines);
  }
  for (const auto& [kind, lines] : log.skipped) {
    std::fprintf(stderr, "%zu lines of the kind %s are left out\n", lines, kind.c_str());
  }
  if (!log.cut_off.empty()) {
    std::fprintf(stderr, "%s; what comes before is kept\n", log.cut_off.c_str());
  }
}

int convert(tools::Arguments& arguments) {
  bridge::CarmenBagOptions options;
  options.reverse_from_tv = arguments.flag("--reverse-from-tv");
  options.odometry_delay = arguments.number("--odometry-delay", 0.0);
  options.laser_offset = arguments.number("--laser-offset", 0.0);
  const std::string in = arguments.positional("IN.clf");
  const std::string out = arguments.positional("OUT.bag");
  arguments.finish();
  const logs::CarmenLog log = logs::readCarmenLog(in);
  printLosses(log);
  const auto contents = bridge::writeCarmenBag(log, options, out);
  std::printf("%zu scans, %zu odometry poses\n", contents.scans, contents.odometry);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return sightline::tools::run(argc, argv, kUsage, convert);
}
