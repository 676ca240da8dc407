#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scripted_transforms.h"
#include "setting_limits.h"
#include "sightline/config/error.h"
#include "sightline/pipeline/estimators.h"
#include "sightline/pipeline/scan_feed.h"
#include "sightline/simulation/simulation.h"

/// All estimators on the same 10 s of scans, with each setting in turn at either end of its range.
namespace sightline::bench {

constexpr double kLimitSeconds = 10.0;

/// 361 beams over 180° at 10 Hz, and wheels, on the way out of the living room of the floor.
class LimitDrive {
 public:
  LimitDrive()
      : simulation_(world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/floor.yaml"), 1),
        carrier_(simulation_.addRobot({}, {-2.2, 4.6, 0.2})) {
    simulation::ScannerProfile profile;
    profile.beams = 361;
    profile.rate = 10.0;
    carrier_.addScanner(profile, {0.1, 0.0, 0.4});
    carrier_.follow(
        simulation::Path::readFile(SIGHTLINE_SOURCE_DIR "/config/paths/floor_tour.yaml"));
    transforms_.mount("", geometry::Pose2(0.1, 0.0, 0.0));
    while (simulation_.time() < static_cast<std::int64_t>(1e9 * kLimitSeconds)) step();
  }

  /// Seconds that it takes.
  double run(const pipeline::EstimatorsConfig& config) const {
    const auto begin = std::chrono::steady_clock::now();
    pipeline::Frames frames;
    pipeline::ScanFeed feed(config.input.feed, frames, {}, transforms_);
    pipeline::Estimators estimators(config, {true, true, true});
    estimators.rooms()->setPose(config.rooms->start());
    feed.addScanner();
    const auto take = [&](std::optional<pipeline::FeedResult> result) {
      if (result && result->located) estimators.take(std::move(*result->located));
      return result.has_value();
    };
    for (const Arrived& arrived : scans_) {
      feed.add(0, arrived.scan, arrived.at);
      while (take(feed.next(arrived.at))) continue;
    }
    while (take(feed.flush())) continue;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

 private:
  struct Arrived {
    scan::Scan scan;
    std::int64_t at;
  };

  void step() {
    simulation::Outputs outputs = simulation_.step();
    for (const auto& state : outputs.states) transforms_.drive(state.stamp, state.pose.mean);
    for (auto& sweep : outputs.sweeps) {
      scans_.push_back({std::move(sweep.scan), simulation_.time()});
    }
  }

  simulation::Simulation simulation_;
  simulation::Carrier& carrier_;
  test::ScriptedTransforms transforms_;
  std::vector<Arrived> scans_;
};

inline pipeline::EstimatorsConfig limitStart() {
  pipeline::EstimatorsConfig config;
  config.rooms.emplace();
  config.rooms->map = SIGHTLINE_SOURCE_DIR "/config/rooms/floor.yaml";
  config.rooms->initial_pose = geometry::Pose2(-2.2, 4.6, 0.2);
  config.odometry.emplace();
  return config;
}

/// Prints offline.limits.*; refused are ends that the settings beside them do not allow.
inline void printLimits() {
  const LimitDrive drive;
  const double defaults = drive.run(limitStart());
  double slowest = 0.0;
  std::string name;
  std::size_t refused = 0;
  const auto limits = test::atBothEnds(limitStart());
  for (const auto& limit : limits) {
    try {
      const double seconds = drive.run(limit.config);
      if (seconds > slowest) name = limit.name;
      slowest = std::max(slowest, seconds);
    } catch (const config::Error& error) {
      ++refused;
      fmt::print("# offline.limits: {} refused: {}\n", limit.name, error.what());
    }
  }
  fmt::print("offline.limits.settings {} 1\n", limits.size());
  fmt::print("offline.limits.refused {} 1\n", refused);
  fmt::print("offline.limits.defaults_s {:.3f} s\n", defaults);
  fmt::print("offline.limits.slowest_s {:.2f} s\n# the slowest: {}\n", slowest, name);
}

}  // namespace sightline::bench
