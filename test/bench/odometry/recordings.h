#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/figures.h"
#include "scan_log.h"
#include "sightline/geometry/angle.h"
#include "sightline/logs/trajectory_error.h"

/// Logs against their hand-verified relations: fr079, and the first part of intel, whose stamps are
/// of arrival. One set of settings, everything else learned; by the scans alone unless it says
/// prior.
///
/// odometry.<log>.*: errors as evaluate_trajectory names them, of intel_part the mean of four runs
/// with 1 mm of noise. <log>_prior: with the wheels. fr079_bursts_<s>: stamps of a buffer that is
/// flushed so often on average, _lost: with a tenth of the scans missing, _shuffled: stamps of a
/// burst in any order. <log>_5cm: ranges in steps of 5 cm. fr079_misses: misses read 8 m, the
/// range_max. fr079_wheels_<fault>: mean error of all relations over that of the unharmed wheels.
/// <log>_skip<k>.bad_steps: only every k-th scan used; share of the steps off by more than 0.2 m or
/// 5° from the relation that spans the step, or from the trajectory of all scans. skips.flagged,
/// false_alarms: of the bad steps, and of the others, those that are flagged, all together.
/// us_mean, us_p99, us_max: a scan of 360 beams; us_max_any_carrier: with the widest bounds, every
/// eighth scan; per_conversion: median over that of turning its ranges into points.
namespace sightline::bench {

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
  fmt::print("{}us_mean {:.0f} us\n", name,
             std::accumulate(run.microseconds.begin(), run.microseconds.end(), 0.0) /
                 static_cast<double>(run.microseconds.size()));
  fmt::print("{}us_median {:.0f} us\n", name, quantile(run.microseconds, 0.5));
  fmt::print("{}us_p99 {:.0f} us\n", name, quantile(run.microseconds, 0.99));
  fmt::print("{}us_max {:.0f} us\n", name, quantile(run.microseconds, 1.0));
  fmt::print("{}per_conversion {:.1f} 1\n", name, quantile(run.microseconds, 0.5) / conversion);
}

/// Source of the truth of a step: relations, and where they are silent a trajectory.
class StepTruth {
 public:
  StepTruth(const std::vector<logs::Relation>& relations, const geometry::Pose2& T_base_measured,
            const logs::Trajectory& trajectory) {
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

/// A log with what is known of it.
struct Recording {
  std::string name;
  ScanLog log;
  std::vector<logs::Relation> relations;
  geometry::Pose2 T_base_measured;
};

inline logs::RelationErrors errorsOf(const Recording& recording, const LogRun& run) {
  return logs::compareWithRelations(run.sorted(), recording.relations, recording.T_base_measured);
}

inline LogRun measureLog(const Recording& recording, const std::string& suffix,
                         const LogRunOptions& options) {
  LogRun run = runLog(recording.log, options);
  fmt::print("{}", logs::figures(errorsOf(recording, run),
                                 fmt::format("odometry.{}{}.", recording.name, suffix)));
  return run;
}

/// Mean of four runs with 1 mm of noise.
inline void measureWithNoise(const Recording& recording) {
  constexpr int kRuns = 4;
  double sums[5] = {};
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    LogRunOptions options;
    options.faults.sigma = 0.001;
    options.faults.seed = seed;
    const auto errors = errorsOf(recording, runLog(recording.log, options));
    const double values[5] = {errors.short_term->translation.mean, errors.short_term->rotation.mean,
                              errors.bad, errors.all->translation.mean, errors.all->rotation.mean};
    for (int i = 0; i < 5; ++i) sums[i] += values[i] / kRuns;
  }
  const std::string name = "odometry." + recording.name;
  fmt::print("{}.short.translation.mean {:.4f} m\n{}.short.rotation.mean {:.4f} deg\n", name,
             sums[0], name, sums[1]);
  fmt::print("{}.short.bad {:.2f} %\n", name, sums[2]);
  fmt::print("{}.all.translation.mean {:.4f} m\n{}.all.rotation.mean {:.4f} deg\n", name, sums[3],
             name, sums[4]);
}

inline void measureBursts(const Recording& recording) {
  for (const double burst : {0.2, 0.5, 1.0}) {
    const std::string suffix = fmt::format("_bursts_{}", burst);
    LogRunOptions options;
    options.faults.burst = burst;
    measureLog(recording, suffix, options);
    options.faults.is_shuffled = true;
    measureLog(recording, suffix + "_shuffled", options);
    options.faults.is_shuffled = false;
    options.faults.lost = 0.1;
    measureLog(recording, suffix + "_lost", options);
  }
}

inline void measureCounts(const Recording& recording) {
  LogRunOptions options;
  options.faults.count = 0.05;
  measureLog(recording, "_5cm", options);
}

inline void measureMisses(const Recording& recording) {
  LogRunOptions options;
  options.faults.clip = 8.0;
  measureLog(recording, "_misses", options);
}

inline void measureWheels(const Recording& recording) {
  LogRunOptions options;
  options.wheels = true;
  const double unharmed =
      errorsOf(recording, measureLog(recording, "_prior", options)).all->translation.mean;
  for (const auto& [fault, name] : {std::pair(WheelFault::kReset, "reset"),
                                    {WheelFault::kFar, "far"},
                                    {WheelFault::kFrozen, "frozen"},
                                    {WheelFault::kSlip, "slip"}}) {
    options.fault = fault;
    const auto errors = errorsOf(recording, runLog(recording.log, options));
    fmt::print("odometry.{}_wheels_{} {:.2f} 1\n", recording.name, name,
               errors.all->translation.mean / unharmed);
  }
}

inline void measureSkips(const Recording& recording, const LogRun& all, StepCount& pooled) {
  const StepTruth truth(recording.relations, recording.T_base_measured, all.trajectory);
  for (const std::size_t stride : {2, 4, 8}) {
    LogRunOptions options;
    options.faults.stride = stride;
    const LogRun run = runLog(recording.log, options);
    StepCount count;
    count.add(run, truth);
    pooled.add(run, truth);
    fmt::print("odometry.{}_skip{}.bad_steps {:.2f} %\n", recording.name, stride,
               100.0 * count.bad / (count.bad + count.good));
  }
}

inline void measureBounds(const Recording& recording) {
  LogRunOptions options;
  options.config.matching.carrier = {50.0, 50.0, 100.0, 100.0};
  options.faults.stride = 8;
  const LogRun run = runLog(recording.log, options);
  print("odometry.us_max_any_carrier", quantile(run.microseconds, 1.0), "us");
}

inline void measureMethods(const Recording& recording, double conversion) {
  using dead_reckoning::Method;
  for (const auto& [method, name] :
       {std::pair(Method::kHistogram, "histogram"), {Method::kPoseSpace, "pose_space"}}) {
    LogRunOptions options;
    options.config.matching.method = method;
    // The thesis's own searches are as wide as the carrier's bounds.
    options.config.matching.carrier = {1.2, 1.5, 0.4, 1.0};
    const LogRun run = measureLog(recording, fmt::format("_{}", name), options);
    printTimes(fmt::format("odometry.{}.", name), run, conversion);
  }
}

inline void measureRecordings(const Recording& freiburg, const Recording* intel) {
  const double conversion = medianConversion(freiburg.log);
  const LogRun plain = measureLog(freiburg, "", {});
  printTimes("odometry.", plain, conversion);
  measureBursts(freiburg);
  measureCounts(freiburg);
  measureMisses(freiburg);
  measureWheels(freiburg);
  measureBounds(freiburg);
  StepCount pooled;
  measureSkips(freiburg, plain, pooled);
  if (intel) {
    measureWithNoise(*intel);
    measureCounts(*intel);
    LogRunOptions options;
    options.wheels = true;
    measureLog(*intel, "_prior", options);
  }
  fmt::print("odometry.skips.flagged {:.1f} %\n",
             100.0 * pooled.bad_flagged / std::max(1.0, pooled.bad));
  fmt::print("odometry.skips.false_alarms {:.2f} %\n", 100.0 * pooled.good_flagged / pooled.good);
  measureMethods(freiburg, conversion);
}

}  // namespace sightline::bench
