// Runs the estimators over a bag, as fast as they go.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

#include "arguments.h"
#include "sightline/bridge/bag_estimators.h"

namespace {

using namespace sightline;
using Clock = std::chrono::steady_clock;

constexpr const char* kUsage =
    "offline --config FILE.yaml IN.bag --out DIR [--nodes lines,rooms] [--no-wheels]\n"
    "  --config     settings: scans, frames, noise, lines, rooms\n"
    "  --out        folder for out.bag and one trajectory, NODE.tum, for each node with a pose\n"
    "  --nodes      what to run; by default lines, and rooms where the settings name some\n"
    "  --no-wheels  leave the odometry of the bag unused\n";

struct Job {
  std::string config;
  std::string in;
  std::filesystem::path out;
  std::vector<std::string> nodes;  // empty: by the settings
  bool use_wheels = true;
};

std::vector<std::string> splitNodes(const std::string& list) {
  std::vector<std::string> nodes;
  std::istringstream stream(list);
  for (std::string node; std::getline(stream, node, ',');) {
    if (node == "odometry" || node == "targets") {
      throw tools::UsageError("--nodes: " + node + " is not part of this version");
    }
    if (node != "lines" && node != "rooms") throw tools::UsageError("--nodes: no node " + node);
    if (std::count(nodes.begin(), nodes.end(), node) == 0) nodes.push_back(node);
  }
  if (nodes.empty()) throw tools::UsageError("--nodes: none given");
  return nodes;
}

std::string required(const std::optional<std::string>& value, const char* name) {
  if (!value) throw tools::UsageError(std::string(name) + " is missing");
  return *value;
}

Job jobOf(tools::Arguments& arguments) {
  Job job;
  job.config = required(arguments.text("--config"), "--config");
  job.out = required(arguments.text("--out"), "--out");
  if (const auto list = arguments.text("--nodes")) job.nodes = splitNodes(*list);
  job.use_wheels = !arguments.flag("--no-wheels");
  job.in = arguments.positional("IN.bag");
  arguments.finish();
  return job;
}

// Opens the bag to write, unless it is the one to read.
void openOut(rosbag::Bag& out, const Job& job) {
  std::filesystem::create_directories(job.out);
  const auto path = job.out / "out.bag";
  if (std::filesystem::exists(path) && std::filesystem::equivalent(path, job.in)) {
    throw config::Error(job.in, 0, "", "is where the result would go");
  }
  out.open(path.string(), rosbag::bagmode::Write);
}

std::vector<std::string> nodesOf(const Job& job, const pipeline::OfflineConfig& config) {
  std::vector<std::string> nodes = job.nodes;
  if (nodes.empty()) nodes = config.rooms ? splitNodes("lines,rooms") : splitNodes("lines");
  const bool rooms = std::count(nodes.begin(), nodes.end(), "rooms") > 0;
  if (rooms && !config.rooms) throw config::Error(job.config, 0, "rooms", "missing");
  if (rooms && !job.use_wheels) {
    throw tools::UsageError("--no-wheels leaves rooms without odometry");
  }
  return nodes;
}

using Estimators = std::vector<std::unique_ptr<bridge::BagEstimator>>;

Estimators makeEstimators(const std::vector<std::string>& nodes,
                          const pipeline::OfflineConfig& config, const Job& job, rosbag::Bag& out) {
  Estimators estimators;
  for (const std::string& node : nodes) {
    if (node == "lines") estimators.push_back(std::make_unique<bridge::BagLines>(config, out));
    if (node == "rooms") {
      estimators.push_back(
          std::make_unique<bridge::BagRooms>(config, out, (job.out / "rooms.tum").string()));
    }
  }
  return estimators;
}

// A bar on a terminal, nothing elsewhere.
class ProgressBar {
 public:
  void show(double share) {
    const int percent = static_cast<int>(100.0 * share);
    if (!on_terminal_ || percent == shown_) return;
    shown_ = percent;
    const std::string done(static_cast<std::size_t>(percent / 2), '=');
    std::fprintf(stderr, "\r[%-50s] %3d %%%s", done.c_str(), percent, percent == 100 ? "\n" : "");
  }

 private:
  bool on_terminal_ = isatty(STDERR_FILENO) == 1;
  int shown_ = -1;
};

void readInto(Estimators& estimators, bridge::BagScans& scans, rosbag::Bag& out) {
  ProgressBar bar;
  bridge::BagScans::Visitor visitor;
  visitor.scan = [&](const bridge::LocatedScan& located, const ros::Time& now) {
    for (auto& estimator : estimators) estimator->process(located, now);
  };
  visitor.message = [&](const rosbag::MessageInstance& message) {
    out.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
  };
  visitor.progress = [&](double share) { bar.show(share); };
  scans.read(visitor);
  for (auto& estimator : estimators) estimator->finish();
  out.close();
}

void printSummary(const Estimators& estimators, const bridge::BagScans& scans, double seconds) {
  for (const auto& [reason, count] : scans.dropped()) {
    std::printf("%zu of %zu scans dropped: %s\n", count, scans.scans(), reason.c_str());
  }
  for (const auto& estimator : estimators) {
    for (const std::string& line : estimator->summary()) std::printf("%s\n", line.c_str());
  }
  std::printf("%.1f s of scans in %.2f s: %.0f times real time\n", scans.duration(), seconds,
              scans.duration() / seconds);
}

int runOffline(tools::Arguments& arguments) {
  const auto start = Clock::now();
  const Job job = jobOf(arguments);
  const auto config = pipeline::OfflineConfig::readFile(job.config);
  const auto nodes = nodesOf(job, config);
  bridge::BagScans scans(job.in, config, job.use_wheels);
  rosbag::Bag out;
  openOut(out, job);
  Estimators estimators = makeEstimators(nodes, config, job, out);
  readInto(estimators, scans, out);
  printSummary(estimators, scans, std::chrono::duration<double>(Clock::now() - start).count());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return sightline::tools::run(argc, argv, kUsage, runOffline);
}
