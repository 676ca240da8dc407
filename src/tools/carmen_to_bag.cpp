// Turns a CARMEN log into a bag.
#include <cstdio>

#include "program/program.h"
#include "sightline/bridge/bag_from_carmen.h"

namespace {

using namespace sightline;

// Says on standard error what does not get from the log into the bag.
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

int convert(const std::string& in, const std::string& out,
            const bridge::CarmenBagOptions& options) {
  const logs::CarmenLog log = logs::readCarmenLog(in);
  printLosses(log);
  const auto contents = bridge::writeCarmenBag(log, options, out);
  if (contents.not_rising > 0) {
    std::fprintf(
        stderr,
        "%zu of %zu scans are stamped no later than the one before: the order of the log is "
        "kept, with rising stamps and the odometry of the scans' own lines; %s.stamps says "
        "what was logged\n",
        contents.not_rising, contents.scans, out.c_str());
  }
  std::printf("%s: %zu scans, %zu odometry poses\n", out.c_str(), contents.scans,
              contents.odometry);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string in;
  std::string out;
  bridge::CarmenBagOptions options;
  tools::Program program("carmen_to_bag", "Turns a CARMEN log into a bag.");
  program.positional("IN.clf", in, "the log, plain or gzipped");
  program.positional("OUT.bag", out,
                     "the bag, with scan, odom and tf; beside it OUT.bag.stamps, `bag-stamp "
                     "logged-stamp` a scan");
  program.flag("--reverse-from-tv", options.reverse_from_tv,
               "turn odometry steps round where the logged velocity is negative");
  program.option("--odometry-delay", options.odometry_delay, "SECONDS",
                 "stamp the odometry later by this");
  program.option("--laser-offset", options.laser_offset, "METRES",
                 "how far the laser sits ahead of base_link");
  return program.run(argc, argv, [&] { return convert(in, out, options); });
}
