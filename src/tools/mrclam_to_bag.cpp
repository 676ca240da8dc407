// Turns a set of the UTIAS multi-robot data into a bag of bearings.
#include <cstdio>

#include "program/program.h"
#include "sightline/bridge/bag_from_mrclam.h"

namespace {

using namespace sightline;

constexpr double kDegree = 0.017453292519943295;

int convert(const std::string& folder, const std::string& out, bridge::MrclamBagOptions options,
            std::uint64_t seed) {
  options.bias *= kDegree;
  options.heading_sigma *= kDegree;
  options.seed = static_cast<int>(seed);
  const auto contents = bridge::writeMrclamBag(logs::readMrclam(folder), options, out);
  std::printf("%zu robots, %zu looks (%zu empty ones put back), %zu bearings, %zu poses\n",
              contents.robots.size(), contents.looks, contents.empty, contents.bearings,
              contents.poses);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  std::string out;
  bridge::MrclamBagOptions options;
  std::uint64_t seed = 1;
  tools::Program program("mrclam_to_bag",
                         "Turns a set of the UTIAS multi-robot data (MRCLAM) into a bag.");
  program.positional("DIR", folder, "the folder of the set, files plain or gzipped");
  program.positional("OUT.bag", out,
                     "the bag, with bearings, pose and odom of each robot; beside it the truth, "
                     "OUT.bag.truth.csv, OUT.bag.ROBOT.tum, OUT.bag.labels.csv");
  program.option("--lag", options.lag, "SECONDS", "looks are stamped late by this");
  program.option("--bias", options.bias, "DEGREES", "measured less true bearing, of all robots");
  program.option("--period", options.period, "SECONDS",
                 "between two images, for the empty looks, which the log leaves out; by default "
                 "found in the log of each robot; negative: leave them out");
  program.option("--from", options.from, "SECONDS",
                 "after the beginning of the set, at which the bag begins");
  program.option("--to", options.to, "SECONDS", "at which it ends");
  program.option("--position-sigma", options.position_sigma, "METRES",
                 "add errors to the poses, in x and in y");
  program.option("--heading-sigma", options.heading_sigma, "DEGREES", "and in heading");
  program.option("--pose-correlation", options.pose_correlation, "SECONDS",
                 "time constant of these errors; 0: each on its own");
  program.option("--seed", seed, "N", "of these errors");
  return program.run(argc, argv, [&] { return convert(folder, out, options, seed); });
}
