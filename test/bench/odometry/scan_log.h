#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/logs/carmen_log.h"
#include "sightline/logs/carmen_odometry.h"
#include "sightline/logs/carmen_stamps.h"
#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/scan_feed.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/scan/noise_model.h"

/// A CARMEN log through feed and odometry, as carmen_to_bag and offline take it: order of the
/// lines, rising stamps, noise and clock learned; and with faults that other logs have.
namespace sightline::bench {

/// Faults put on a log.
struct LogFaults {
  std::size_t stride = 1;    ///< only every so many scans
  double burst = 0.0;        ///< mean time between two flushes of a buffer [s]; 0: none
  bool is_shuffled = false;  ///< stamps within a burst are in any order
  double lost = 0.0;         ///< share of the scans that are missing
  double count = 0.0;        ///< step in which ranges are counted [m]; 0: as logged
  double sigma = 0.0;        ///< noise that is added [m]
  double clip = 0.0;         ///< misses read this [m]; 0: as logged
  std::uint64_t seed = 1;
};

/// Faults put on the wheels of a log, from its 2000th scan on.
enum class WheelFault { kNone, kReset, kFar, kFrozen, kSlip };

/// No transforms: scans are of the base.
class NoTransforms : public pipeline::Transforms {
 public:
  std::optional<Eigen::Isometry3d> at(const std::string&, const std::string&,
                                      std::int64_t) const override {
    return std::nullopt;
  }
  std::optional<Newest> newest(const std::string&, const std::string&) const override {
    return std::nullopt;
  }
};

/// A log's scans and wheels.
class ScanLog {
 public:
  /// @param is_repaired  whether the wheels are those of fr079, to be repaired as `carmen_to_bag
  ///                     --reverse-from-tv --odometry-delay 0.12` does
  explicit ScanLog(const std::string& path, bool is_repaired)
      : log_(logs::readCarmenLog(path)), stamps_(logs::risingStamps(log_)) {
    auto wheels = logs::odometryOf(log_);
    if (is_repaired) logs::reverseFromVelocity(wheels);
    const std::int64_t delay = is_repaired ? 120'000'000 : 0;  // ns
    for (const logs::CarmenOdometry& odometry : wheels) {
      wheels_.add(odometry.stamp + delay, odometry.robot);
    }
  }

  std::size_t size() const { return log_.scans.size(); }
  std::int64_t stamp(std::size_t index) const { return stamps_[index]; }
  std::int64_t logged(std::size_t index) const { return log_.scans[index].stamp; }

  scan::Scan scan(std::size_t index) const {
    scan::Scan scan = scanOf(index, kRangeMax, rangesOf(index));
    scan::applyNoise({}, scan);
    return scan;
  }

  /// The scan with faults, at a stamp; a miss of its own value is at the range limit.
  scan::Scan scan(std::size_t index, const LogFaults& faults, std::int64_t stamp,
                  std::mt19937_64& random) const {
    std::normal_distribution<double> noise(0.0, 1.0);
    std::vector<double> ranges = rangesOf(index);
    for (double& range : ranges) {
      if (faults.sigma > 0.0) range += faults.sigma * noise(random);
      if (faults.count > 0.0) range = faults.count * std::round(range / faults.count);
      if (faults.clip > 0.0) range = std::min(range, faults.clip);
    }
    scan::Scan scan = scanOf(index, faults.clip > 0.0 ? faults.clip : kRangeMax, std::move(ranges));
    scan.stamp = stamp;
    return scan;
  }

  std::optional<geometry::Pose2> wheelsAt(std::int64_t stamp) const { return wheels_.at(stamp); }

 private:
  static constexpr double kRangeMax = 80.0;  // m

  std::vector<double> rangesOf(std::size_t index) const {
    const auto& ranges = log_.scans[index].ranges;
    return {ranges.begin(), ranges.end()};
  }

  scan::Scan scanOf(std::size_t index, double range_max, std::vector<double> ranges) const {
    const logs::CarmenLaser& laser = log_.scans[index];
    return {scan::ScanGeometry::uniform(laser.angle_min, laser.angle_increment, ranges.size(), 0.0,
                                        0.0, laser.range_max.value_or(range_max)),
            stamps_[index], std::move(ranges)};
  }

  logs::CarmenLog log_;
  std::vector<std::int64_t> stamps_;
  motion::PoseHistory wheels_{std::numeric_limits<std::int64_t>::max()};
};

/// A scan of a log that gets through, and when.
struct Arrival {
  std::size_t index = 0;
  std::int64_t stamp = 0;  // ns
};

/// Gives the scans of each burst the times of its flush, a millisecond apart.
inline void gatherBursts(const LogFaults& faults, std::mt19937_64& random,
                         std::vector<Arrival>& arrivals) {
  std::exponential_distribution<double> pause(1.0 / faults.burst);
  constexpr std::int64_t kApart = 1'000'000;  // ns
  std::int64_t flush = arrivals.front().stamp;
  for (auto first = arrivals.begin(); first != arrivals.end();) {
    while (flush < first->stamp) flush += std::llround(1e9 * pause(random));
    auto end = first;
    std::vector<std::int64_t> stamps;
    for (; end != arrivals.end() && end->stamp <= flush; ++end) {
      stamps.push_back(flush + kApart * (end - first));
    }
    if (faults.is_shuffled) std::shuffle(stamps.begin(), stamps.end(), random);
    for (auto i = first; i != end; ++i) i->stamp = stamps[static_cast<std::size_t>(i - first)];
    first = end;
  }
}

inline std::vector<Arrival> arrivalsOf(const ScanLog& log, const LogFaults& faults,
                                       std::mt19937_64& random) {
  std::bernoulli_distribution is_lost(faults.lost);
  std::vector<Arrival> arrivals;
  for (std::size_t i = 0; i < log.size(); i += faults.stride) {
    if (faults.lost == 0.0 || !is_lost(random)) arrivals.push_back({i, log.stamp(i)});
  }
  if (faults.burst > 0.0) gatherBursts(faults, random, arrivals);
  return arrivals;
}

struct LogRun {
  logs::Trajectory trajectory;       // at the logged stamps, in the order of the log
  std::vector<bool> flagged;         // by scan
  std::vector<double> microseconds;  // by scan

  logs::Trajectory sorted() const {
    logs::Trajectory poses = trajectory;
    std::stable_sort(poses.begin(), poses.end(),
                     [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
    return poses;
  }
};

struct LogRunOptions {
  pipeline::ScanOdometryConfig config = {};
  bool wheels = false;
  WheelFault fault = WheelFault::kNone;
  LogFaults faults = {};
};

/// Pose by wheels with a fault, at the so-manieth scan.
inline geometry::Pose2 faulty(WheelFault fault, std::size_t scan, const geometry::Pose2& pose,
                              const geometry::Pose2& at_fault) {
  constexpr std::size_t kFault = 2000;
  constexpr std::size_t kFrozen = 24;  // scans: 5 s
  const bool is_after = scan >= kFault;
  if (fault == WheelFault::kReset && is_after) return geometry::between(at_fault, pose);
  if (fault == WheelFault::kFar && scan % 500 == 499)
    return {pose.x() + 1e5, pose.y(), pose.theta()};
  if (fault == WheelFault::kFrozen && is_after && scan < kFault + kFrozen) return at_fault;
  if (fault == WheelFault::kSlip && is_after) {
    return pose * geometry::Pose2(0.0, 0.0, geometry::radians(20.0));
  }
  return pose;
}

class LogRunner {
 public:
  LogRunner(const ScanLog& log, const LogRunOptions& options)
      : log_(log),
        options_(options),
        random_(options.faults.seed),
        feed_(withoutWheels(), {}, {false, false}, transforms_),
        odometry_(options.config) {
    feed_.addScanner();
    if (const auto pose = log.wheelsAt(log.stamp(std::min<std::size_t>(2000, log.size() - 1)))) {
      at_fault_ = *pose;
    }
  }

  LogRun run() {
    std::vector<Arrival> waiting;
    for (const Arrival& arrival : arrivalsOf(log_, options_.faults, random_)) {
      feed_.add(0, log_.scan(arrival.index, options_.faults, arrival.stamp, random_),
                log_.stamp(arrival.index));
      waiting.push_back(arrival);
      while (const auto result = feed_.flush()) take(*result, waiting);
    }
    return std::move(run_);
  }

 private:
  static pipeline::FeedConfig withoutWheels() {
    pipeline::FeedConfig config;
    config.odometry_source = pipeline::OdometrySource::kNone;
    return config;
  }

  void take(const pipeline::FeedResult& result, std::vector<Arrival>& waiting) {
    const auto arrival = std::find_if(waiting.begin(), waiting.end(), [&](const Arrival& other) {
      return other.stamp == result.stamp;
    });
    const std::size_t index = arrival->index;
    waiting.erase(arrival);
    if (!result.located) return;
    pipeline::LocatedScan located = *result.located;
    if (options_.wheels) {
      const auto pose = log_.wheelsAt(log_.stamp(index));
      if (pose) located.T_odom_base = faulty(options_.fault, index, *pose, at_fault_);
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto update = odometry_.update(located);
    const std::chrono::duration<double, std::micro> spent =
        std::chrono::steady_clock::now() - begin;
    if (!update) return;
    run_.trajectory.push_back({log_.logged(index), update->pose.mean});
    run_.flagged.push_back(update->isFlagged());
    run_.microseconds.push_back(spent.count());
  }

  const ScanLog& log_;
  LogRunOptions options_;
  std::mt19937_64 random_;
  NoTransforms transforms_;
  pipeline::ScanFeed feed_;
  pipeline::ScanOdometry odometry_;
  geometry::Pose2 at_fault_;
  LogRun run_;
};

inline LogRun runLog(const ScanLog& log, const LogRunOptions& options) {
  return LogRunner(log, options).run();
}

}  // namespace sightline::bench
