// Runs the estimators over a bag, as fast as they go.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "program/program.h"
#include "sightline/bridge/bag_estimators.h"

namespace {

using namespace sightline;
using Clock = std::chrono::steady_clock;

struct Job {
  std::string config;
  std::string in;
  std::string out;
  std::vector<std::string> nodes;  // empty: by the settings
  bool no_wheels = false;
};

std::vector<std::string> splitNodes(const std::string& list) {
  std::vector<std::string> nodes;
  std::istringstream stream(list);
  for (std::string node; std::getline(stream, node, ',');) {
    if (node == "targets") {
      throw tools::UsageError("--nodes: " + node + " is not part of this version");
    }
    if (node != "lines" && node != "rooms" && node != "odometry") {
      throw tools::UsageError("--nodes: no node " + node);
    }
    if (std::count(nodes.begin(), nodes.end(), node) == 0) nodes.push_back(node);
  }
  if (nodes.empty()) throw tools::UsageError("--nodes: none given");
  return nodes;
}

// Opens the bag to write, unless it is the one to read.
void openOut(rosbag::Bag& out, const Job& job) {
  std::filesystem::create_directories(job.out);
  const auto path = std::filesystem::path(job.out) / "out.bag";
  if (std::filesystem::exists(path) && std::filesystem::equivalent(path, job.in)) {
    throw config::Error(job.in, 0, "", "is where the result would go");
  }
  out.open(path.string(), rosbag::bagmode::Write);
}

std::vector<std::string> nodesOf(const pipeline::OfflineConfig& config) {
  std::vector<std::string> nodes{"lines"};
  if (config.rooms) nodes.emplace_back("rooms");
  if (config.odometry) nodes.emplace_back("odometry");
  return nodes;
}

std::vector<std::string> nodesOf(const Job& job, const pipeline::OfflineConfig& config) {
  const std::vector<std::string> nodes = job.nodes.empty() ? nodesOf(config) : job.nodes;
  const bool rooms = std::count(nodes.begin(), nodes.end(), "rooms") > 0;
  if (rooms && !config.rooms) throw config::Error(job.config, 0, "rooms", "missing");
  if (rooms && job.no_wheels) {
    throw tools::UsageError("--no-wheels leaves rooms without odometry");
  }
  return nodes;
}

using Estimators = std::vector<std::unique_ptr<bridge::BagEstimator>>;

Estimators makeEstimators(const std::vector<std::string>& nodes,
                          const pipeline::OfflineConfig& config, const Job& job, rosbag::Bag& out) {
  Estimators estimators;
  for (const std::string& node : nodes) {
    const std::string trajectory = (std::filesystem::path(job.out) / (node + ".tum")).string();
    if (node == "lines") {
      estimators.push_back(std::make_unique<bridge::BagLines>(config, out));
    } else if (node == "rooms") {
      estimators.push_back(std::make_unique<bridge::BagRooms>(config, out, trajectory));
    } else {
      estimators.push_back(std::make_unique<bridge::BagOdometry>(config, out, trajectory));
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

int runOffline(const Job& job) {
  const auto start = Clock::now();
  const auto config = pipeline::OfflineConfig::readFile(job.config);
  const auto nodes = nodesOf(job, config);
  bridge::BagScans scans(job.in, config, !job.no_wheels);
  rosbag::Bag out;
  openOut(out, job);
  Estimators estimators = makeEstimators(nodes, config, job, out);
  readInto(estimators, scans, out);
  printSummary(estimators, scans, std::chrono::duration<double>(Clock::now() - start).count());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  std::optional<std::string> nodes;
  tools::Program program("offline", "Runs the estimators over a bag, as fast as they go.");
  program.positional("IN.bag", job.in, "the bag to read");
  program.requiredOption("--config", job.config, "FILE.yaml",
                         "settings: scans, frames, noise, lines, rooms, carrier, odometry");
  program.requiredOption("--out", job.out, "DIR",
                         "folder for out.bag and one trajectory, NODE.tum, for each node with a "
                         "pose");
  program.option("--nodes", nodes, "lines,rooms,odometry",
                 "what to run; by default lines, and rooms and odometry where the settings ask for "
                 "them");
  program.flag("--no-wheels", job.no_wheels, "leave the odometry of the bag unused");
  return program.run(argc, argv, [&] {
    if (nodes) job.nodes = splitNodes(*nodes);
    return runOffline(job);
  });
}
