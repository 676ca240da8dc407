// Runs the estimators over recordings, as fast as they go.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "program/program.h"
#include "program/progress_bar.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/bridge/recorded_estimates.h"
#include "sightline/bridge/recorded_targets.h"
#include "sightline/logs/trajectory.h"
#include "sightline/mapping/path_adjuster.h"

namespace {

using namespace sightline;
using Clock = std::chrono::steady_clock;

struct Job {
  std::string config;
  std::vector<std::string> in;
  std::string out;
  std::optional<std::string> nodes;  // by default by the settings
  bool no_wheels = false;
};

// Estimators that run scan by scan, and what is made of the whole recording.
struct Nodes {
  pipeline::EstimatorSet set;
  bool map = false;

  bool any() const { return set.lines || set.rooms || set.odometry || map; }
};

Nodes nodesOf(const std::string& list) {
  Nodes nodes;
  pipeline::EstimatorSet& set = nodes.set;
  std::istringstream stream(list);
  for (std::string node; std::getline(stream, node, ',');) {
    if (node == "targets") {
      throw tools::UsageError("--nodes: targets runs alone, as it takes bearings, not scans");
    }
    if (node == "lines") {
      set.lines = true;
    } else if (node == "rooms") {
      set.rooms = true;
    } else if (node == "odometry") {
      set.odometry = true;
    } else if (node == "map") {
      nodes.map = true;
    } else {
      throw tools::UsageError("--nodes: no node " + node);
    }
  }
  nodes.set.features = nodes.set.lines;
  if (!nodes.any()) throw tools::UsageError("--nodes: none given");
  return nodes;
}

Nodes nodesOf(const Job& job, const pipeline::EstimatorsConfig& config) {
  const Nodes by_settings{{true, config.rooms.has_value(), config.odometry.has_value(), true}};
  const Nodes nodes = job.nodes ? nodesOf(*job.nodes) : by_settings;
  if (nodes.set.rooms && !config.rooms) throw config::Error(job.config, 0, "rooms", "missing");
  if (nodes.set.rooms && job.no_wheels && !nodes.set.odometry) {
    throw tools::UsageError("--no-wheels leaves rooms without odometry: add it to --nodes");
  }
  return nodes;
}

// Makes the folder, unless a bag to read is where the bag to write would go.
void prepareOut(const Job& job) {
  std::filesystem::create_directories(job.out);
  const auto path = std::filesystem::path(job.out) / "out.bag";
  for (const std::string& in : job.in) {
    if (std::filesystem::exists(path) && std::filesystem::equivalent(path, in)) {
      throw config::Error(in, 0, "", "is where the result would go");
    }
  }
}

// The path of the whole recording, its loops closed, as map.tum.
void writeMap(const mapping::Survey& survey, const Job& job) {
  const mapping::AdjustedPath adjusted = mapping::PathAdjuster(survey.keys(), {}).adjust();
  logs::TrajectoryWriter writer((std::filesystem::path(job.out) / "map.tum").string());
  for (const auto& pose : mapping::posesOf(survey.path(), survey.keys(), adjusted.keys)) {
    writer.add(pose.stamp, pose.pose);
  }
  writer.close();
  std::printf("map: %zu scans, %zu key scans, %zu loops closed, %zu refused\n",
              survey.path().size(), survey.keys().size(), adjusted.loops, adjusted.refused);
}

void run(bridge::BagFeed& feed, bridge::RecordedEstimates& estimates, mapping::Survey* survey) {
  tools::ProgressBar bar;
  bridge::BagFeed::Visitor visitor;
  visitor.scan = [&](pipeline::LocatedScan located, const ros::Time& now) {
    if (survey) survey->take(located);
    estimates.take(std::move(located), now);
  };
  visitor.message = [&](const rosbag::MessageInstance& message) { estimates.copy(message); };
  visitor.progress = [&](double ratio) { bar.show(ratio); };
  feed.read(visitor);
  estimates.close();
}

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
}

void printInput(const bridge::BagFeed& feed) {
  for (const auto& [reason, count] : feed.dropped()) {
    std::printf("%zu of %zu scans dropped: %s\n", count, feed.scans(), reason.c_str());
  }
  for (const auto& [reason, count] : feed.refused()) {
    std::printf("%zu messages dropped: %s\n", count, reason.c_str());
  }
  print(feed.mended());
  print(feed.faultsOfTurns());
  if (feed.breaks() > 0) {
    std::printf("the odometry broke %zu times: bridged by the scans\n", feed.breaks());
  }
  if (feed.restarts() > 0) {
    std::printf("the clock was set %zu times: started again\n", feed.restarts());
  }
  if (feed.withoutMotion() > 0) {
    std::printf("%zu of %zu scans without known motion within the sweep\n", feed.withoutMotion(),
                feed.scans());
  }
}

// The exit status. The last lines tell of estimators that fall short, and of a damaged bag.
int judge(const bridge::RecordedEstimates& estimates, const bridge::BagFeed& feed) {
  constexpr int kDamaged = 1;
  constexpr int kFallsShort = 3;
  int status = 0;
  for (const bridge::EstimatorCount& count : estimates.counts()) {
    if (!bridge::fallsShort(count, feed.scans())) continue;
    print(bridge::explainShortfall(count, feed.scans(), feed.dropped()));
    status = kFallsShort;
  }
  if (feed.damage().empty()) return status;
  std::fprintf(stderr, "%s\n", feed.damage().c_str());
  return kDamaged;
}

int report(const bridge::RecordedEstimates& estimates, const bridge::BagFeed& feed,
           double seconds) {
  printInput(feed);
  print(estimates.summary());
  std::printf("%.1f s of scans in %.2f s: %.0f times real time\n", feed.duration(), seconds,
              feed.duration() / seconds);
  return judge(estimates, feed);
}

int runTargets(const Job& job, const pipeline::EstimatorsConfig& config) {
  const auto start = Clock::now();
  if (!config.targets) throw config::Error(job.config, 0, "targets", "missing");
  prepareOut(job);
  bridge::RecordedTargets run(job.in, *config.targets, job.out);
  tools::ProgressBar bar;
  run.read([&](double ratio) { bar.show(ratio); });
  print(run.summary());
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  std::printf("%.1f s of looks in %.2f s: %.0f times real time\n", run.duration(), seconds,
              run.duration() / seconds);
  constexpr int kNothing = 3;
  return run.used() > 0 ? 0 : kNothing;
}

int runOffline(const Job& job) {
  const auto start = Clock::now();
  auto config = pipeline::EstimatorsConfig::readFile(job.config);
  if (job.no_wheels) config.input.feed.odometry_source = pipeline::OdometrySource::kNone;
  if (job.nodes == "targets") return runTargets(job, config);
  const Nodes nodes = nodesOf(job, config);
  bridge::BagFeed feed(job.in, config, {});
  prepareOut(job);
  bridge::RecordedEstimates estimates(config, nodes.set, job.out);
  std::optional<mapping::Survey> survey;
  if (nodes.map) survey.emplace(config);
  run(feed, estimates, survey ? &*survey : nullptr);
  if (survey) writeMap(*survey, job);
  return report(estimates, feed, std::chrono::duration<double>(Clock::now() - start).count());
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("offline", "Runs the estimators over recordings, as fast as they go.");
  program.positionals("IN.bag", job.in, "the bags to read, as one");
  program.requiredOption(
      "--config", job.config, "FILE.yaml",
      "settings: scans, frames, noise, lines, rooms, carrier, odometry, targets");
  program.requiredOption("--out", job.out, "DIR",
                         "folder for out.bag and one trajectory, NODE.tum, for each node with a "
                         "pose; targets.csv for targets");
  program.option("--nodes", job.nodes, "lines,rooms,odometry,map|targets",
                 "what to run; by default lines, and rooms and odometry where the settings ask for "
                 "them");
  program.flag("--no-wheels", job.no_wheels,
               "leave the odometry of the bag unused: rooms go by that of the scans");
  return program.run(argc, argv, [&] { return runOffline(job); });
}
