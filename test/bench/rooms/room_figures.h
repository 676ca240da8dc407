#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/figures.h"
#include "bench/rooms/playback.h"
#include "sightline/geometry/statistics.h"

namespace sightline::bench {

/// Figures of the runs of one scenario. Times are in seconds and of the worst run; RMSE, NEES and
/// shares are means over the runs, from 5 s on.
class RoomFigures {
 public:
  void add(const std::vector<TrackedScan>& run, double period) {
    double square = 0.0, heading = 0.0, nees = 0.0, inside = 0.0, counted = 0.0;
    double lost = 0.0, unflagged = 0.0, flagged = 0.0;
    for (const TrackedScan& scan : run) {
      largest_ = std::max(largest_, scan.has_pose ? scan.position_error : 0.0);
      lost += scan.isRight() ? 0.0 : period;
      unflagged += !scan.isRight() && scan.isClaimed() ? period : 0.0;
      flagged += scan.isRight() && !scan.isClaimed() ? 1.0 : 0.0;
      times_.push_back(scan.microseconds);
      if (scan.time < 5.0 || !scan.has_pose) continue;
      counted += 1.0;
      square += scan.position_error * scan.position_error;
      heading += scan.heading_error * scan.heading_error;
      nees += scan.nees;
      inside += scan.nees <= geometry::kChiSquare95Of3 ? 1.0 : 0.0;
    }
    counted = std::max(counted, 1.0);
    rmse_.push_back(std::sqrt(square / counted));
    heading_.push_back(std::sqrt(heading / counted));
    nees_.push_back(nees / counted);
    inside_.push_back(inside / counted);
    lost_.push_back(lost);
    unflagged_.push_back(unflagged);
    flagged_.push_back(flagged / static_cast<double>(std::max<std::size_t>(1, run.size())));
  }

  void printAccuracy(const std::string& name) const {
    print(name + ".rmse_m", mean(rmse_), "m");
    print(name + ".max_m", largest_, "m");
    print(name + ".heading_rmse_deg", geometry::degrees(mean(heading_)), "deg");
    print(name + ".nees", mean(nees_), "1");
    print(name + ".in_gate", 100.0 * mean(inside_), "%");
    printKnowing(name);
  }
  void printKnowing(const std::string& name) const {
    print(name + ".lost_s", worst(lost_), "s");
    print(name + ".unflagged_s", worst(unflagged_), "s");
    print(name + ".flagged_percent", 100.0 * mean(flagged_), "%");
  }
  void printTime(const std::string& name) const {
    print(name + ".us_median", quantile(times_, 0.5), "us");
    print(name + ".us_p99", quantile(times_, 0.99), "us");
  }

 private:
  static double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
  }
  static double worst(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
  }

  double largest_ = 0.0;
  std::vector<double> rmse_, heading_, nees_, inside_, lost_, unflagged_, flagged_, times_;
};

/// Quality against the share of scans that are right: the expected calibration error over tenths.
class QualityCalibration {
 public:
  void add(const std::vector<TrackedScan>& run, double period) {
    double wrong = 0.0;
    for (const TrackedScan& scan : run) {
      if (!scan.has_pose) continue;
      const auto bin = std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * scan.quality));
      ++counts_[bin];
      ++total_;
      quality_[bin] += scan.quality;
      right_[bin] += scan.isRight() ? 1.0 : 0.0;
      wrong = !scan.isRight() && scan.isClaimed() ? wrong + period : 0.0;
      wrong_tracking_ += wrong > 1.0 ? 1.0 : 0.0;
    }
  }
  void printFigures() const {
    double error = 0.0;
    for (std::size_t i = 0; i < 10; ++i) error += std::abs(quality_[i] - right_[i]);
    print("rooms.quality_error", error / std::max(1.0, total_), "1");
    print("rooms.wrong_tracking_percent", 100.0 * wrong_tracking_ / std::max(1.0, total_), "%");
  }

 private:
  double counts_[10] = {}, quality_[10] = {}, right_[10] = {};
  double total_ = 0.0;
  double wrong_tracking_ = 0.0;
};

}  // namespace sightline::bench
