#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/figures.h"
#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/geometry/angle.h"
#include "sightline/logs/carmen_log.h"
#include "sightline/logs/carmen_odometry.h"
#include "sightline/logs/trajectory_error.h"
#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/scan/noise_model.h"

/// The log fr079 against its hand-verified relations.
///
/// odometry.fr079.*: by the scans alone, errors as evaluate_trajectory names them; fr079_prior.*:
/// with the wheels as prior, repaired as `carmen_to_bag --reverse-from-tv --odometry-delay 0.12`
/// does; fr079_pose_space.*, fr079_histogram.*: by the other methods. fr079_skip<k>.bad_steps: only
/// every k-th scan used; share of the steps off by more than 0.2 m or 5° from the relation that
/// spans the step, or from the trajectory of fr079_prior. fr079_skips.flagged, false_alarms: of the
/// bad steps, and of the others, those that are flagged, all three together. us_median, us_p99: a
/// scan of 360 beams; per_conversion: median over that of turning its ranges into points.
namespace sightline::bench {

/// A log's scans and wheels.
class ScanLog {
 public:
  explicit ScanLog(const std::string& path) : log_(logs::readCarmenLog(path)) {
    auto wheels = logs::odometryOf(log_);
    logs::reverseFromVelocity(wheels);
    constexpr std::int64_t kDelay = 120'000'000;  // ns
    for (const logs::CarmenOdometry& odometry : wheels) {
      wheels_.add(odometry.stamp + kDelay, odometry.robot);
    }
  }

  std::size_t size() const { return log_.scans.size(); }

  scan::Scan scan(std::size_t index) const {
    constexpr double kRangeMax = 80.0;  // m
    const logs::CarmenLaser& laser = log_.scans[index];
    scan::Scan scan(
        scan::ScanGeometry::uniform(laser.angle_min, laser.angle_increment, laser.ranges.size(),
                                    0.0, 0.0, laser.range_max.value_or(kRangeMax)),
        laser.stamp, {laser.ranges.begin(), laser.ranges.end()});
    scan::applyNoise({}, scan);
    return scan;
  }

  std::optional<geometry::Pose2> wheelsAt(std::int64_t stamp) const { return wheels_.at(stamp); }

 private:
  logs::CarmenLog log_;
  motion::PoseHistory wheels_{std::numeric_limits<std::int64_t>::max()};
};

struct LogRun {
  logs::Trajectory trajectory;
  std::vector<bool> flagged;         // by scan
  std::vector<double> microseconds;  // by scan
};

struct LogRunOptions {
  dead_reckoning::Method method = dead_reckoning::Method::kSubmap;
  bool wheels = false;
  std::size_t stride = 1;
};

inline LogRun runLog(const ScanLog& log, const LogRunOptions& options) {
  pipeline::ScanOdometryConfig config;
  config.matching.method = options.method;
  pipeline::ScanOdometry odometry(config);
  LogRun run;
  for (std::size_t i = 0; i < log.size(); i += options.stride) {
    const scan::Scan scan = log.scan(i);
    pipeline::LocatedScan located;
    located.scan = scan;
    if (options.wheels) located.T_odom_base = log.wheelsAt(scan.stamp);
    const auto begin = std::chrono::steady_clock::now();
    const auto update = odometry.update(located);
    const std::chrono::duration<double, std::micro> spent =
        std::chrono::steady_clock::now() - begin;
    if (!update) continue;
    run.trajectory.push_back({update->stamp, update->pose.mean});
    run.flagged.push_back(update->isFlagged());
    run.microseconds.push_back(spent.count());
  }
  return run;
}

/// Ranges and angles to points, with the trigonometry that a conversion of its own would do.
inline double medianConversion(const ScanLog& log) {
  std::vector<double> times;
  std::vector<double> points;
  for (std::size_t i = 0; i < log.size(); i += 10) {
    const scan::Scan scan = log.scan(i);
    const std::vector<double>& angles = scan.geometry()->angles();
    points.assign(2 * scan.beams(), 0.0);
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t k = 0; k < scan.beams(); ++k) {
      points[2 * k] = scan.ranges()[k] * std::cos(angles[k]);
      points[2 * k + 1] = scan.ranges()[k] * std::sin(angles[k]);
    }
    // Or the optimiser would leave the work out.
    asm volatile("" : : "r"(points.data()) : "memory");
    const std::chrono::duration<double, std::micro> spent =
        std::chrono::steady_clock::now() - begin;
    times.push_back(spent.count());
  }
  return quantile(times, 0.5);
}

inline void printTimes(const std::string& name, const LogRun& run, double conversion) {
  fmt::print("{}us_median {:.0f} us\n", name, quantile(run.microseconds, 0.5));
  fmt::print("{}us_p99 {:.0f} us\n", name, quantile(run.microseconds, 0.99));
  fmt::print("{}per_conversion {:.1f} 1\n", name, quantile(run.microseconds, 0.5) / conversion);
}

/// Source of the truth of a step: relations, and where they are silent a trajectory.
class StepTruth {
 public:
  // The relations hold 4 cm ahead of the point that scans and odometry share.
  StepTruth(const std::vector<logs::Relation>& relations, const logs::Trajectory& trajectory) {
    const geometry::Pose2 T_base_measured(0.04, 0.0, 0.0);
    for (const logs::Relation& relation : relations) {
      relations_[{milliseconds(relation.first), milliseconds(relation.second)}] =
          T_base_measured * relation.motion * T_base_measured.inverse();
    }
    for (const geometry::StampedPose2& pose : trajectory) poses_[pose.stamp] = pose.pose;
  }

  std::optional<geometry::Pose2> step(std::int64_t first, std::int64_t second) const {
    const auto relation = relations_.find({milliseconds(first), milliseconds(second)});
    if (relation != relations_.end()) return relation->second;
    const auto a = poses_.find(first);
    const auto b = poses_.find(second);
    if (a == poses_.end() || b == poses_.end()) return std::nullopt;
    return geometry::between(a->second, b->second);
  }

 private:
  static std::int64_t milliseconds(std::int64_t stamp) { return (stamp + 500'000) / 1'000'000; }

  std::map<std::pair<std::int64_t, std::int64_t>, geometry::Pose2> relations_;
  std::map<std::int64_t, geometry::Pose2> poses_;
};

struct StepCount {
  double bad = 0.0;
  double good = 0.0;
  double bad_flagged = 0.0;
  double good_flagged = 0.0;

  void add(const LogRun& run, const StepTruth& truth) {
    for (std::size_t i = 1; i < run.trajectory.size(); ++i) {
      const auto step = truth.step(run.trajectory[i - 1].stamp, run.trajectory[i].stamp);
      if (!step) continue;
      const geometry::Pose2 error = geometry::between(
          *step, geometry::between(run.trajectory[i - 1].pose, run.trajectory[i].pose));
      const bool is_bad =
          error.translation().norm() > 0.2 || std::abs(error.theta()) > geometry::radians(5.0);
      (is_bad ? bad : good) += 1.0;
      if (run.flagged[i]) (is_bad ? bad_flagged : good_flagged) += 1.0;
    }
  }
};

inline void printSkips(const ScanLog& log, const StepTruth& truth) {
  StepCount pooled;
  for (const std::size_t stride : {2, 4, 8}) {
    const LogRun run = runLog(log, {dead_reckoning::Method::kSubmap, false, stride});
    StepCount count;
    count.add(run, truth);
    pooled.add(run, truth);
    fmt::print("odometry.fr079_skip{}.bad_steps {:.2f} %\n", stride,
               100.0 * count.bad / (count.bad + count.good));
  }
  fmt::print("odometry.fr079_skips.flagged {:.1f} %\n",
             100.0 * pooled.bad_flagged / std::max(1.0, pooled.bad));
  fmt::print("odometry.fr079_skips.false_alarms {:.2f} %\n",
             100.0 * pooled.good_flagged / pooled.good);
}

inline void measureFreiburg(const ScanLog& log, const std::vector<logs::Relation>& relations) {
  using dead_reckoning::Method;
  const geometry::Pose2 T_base_measured(0.04, 0.0, 0.0);
  const auto print = [&](const LogRun& run, const std::string& name) {
    const auto errors = logs::compareWithRelations(run.trajectory, relations, T_base_measured);
    fmt::print("{}", logs::figures(errors, "odometry." + name + "."));
  };
  const double conversion = medianConversion(log);
  const LogRun plain = runLog(log, {});
  print(plain, "fr079");
  printTimes("odometry.", plain, conversion);
  const LogRun prior = runLog(log, {Method::kSubmap, true, 1});
  print(prior, "fr079_prior");
  printSkips(log, StepTruth(relations, prior.trajectory));
  for (const auto& [method, name] :
       {std::pair(Method::kHistogram, "histogram"), {Method::kPoseSpace, "pose_space"}}) {
    const LogRun run = runLog(log, {method, false, 1});
    print(run, fmt::format("fr079_{}", name));
    printTimes(fmt::format("odometry.{}.", name), run, conversion);
  }
}

}  // namespace sightline::bench
