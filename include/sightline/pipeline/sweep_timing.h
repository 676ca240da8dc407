#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/cost_profile.h"
#include "sightline/pipeline/delay_regression.h"
#include "sightline/pipeline/profile_turn.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// Learns when one scanner's beams are measured, by the clock of the odometry: drivers stamp the
/// end of a sweep, or the arrival of its message, and say of a sweep that it lasts another time, or
/// runs in the other order, than it does.
///
/// The turn between two scans, by their ranges, is held against the turns that the odometry tells
/// of times before and after their stamps: only where the turn rate changes does that tell the
/// scan's time. The duration of a sweep shows where a turn brings the last beams' view before the
/// first ones, as a scanner of a whole circle has it.
///
/// A declared time is only given up where it is certainly wrong.
class SweepTiming {
 public:
  SweepTiming();

  /// Takes a scan of evenly spaced beams that was located, and where the base then was by its
  /// odometry.
  /// @param shift  that correct() returned for it [ns]
  void add(const scan::Scan& scan, std::int64_t shift, const geometry::Pose2& T_odom_base,
           const geometry::Pose2& T_base_sensor);
  /// Forgets the last scans: the odometry broke, or the clock was set.
  void skip();

  /// Corrects the sweep of a scan as it arrives. Returns what is to be added to its stamp where the
  /// odometry is looked up [ns]: the stamp itself stays, as others know the scan by it. That comes
  /// by and by, so that no scan's odometry is from before the last one's.
  std::int64_t correct(scan::Scan& scan);

  /// What is to be corrected, in words; empty where nothing is.
  std::string fault() const;

  /// Time of the sweep's middle after the stamp as it arrived, and time from the first beam to the
  /// last, as far as they are known [s].
  std::optional<Determined> middle() const { return middles_.delay(); }
  std::optional<Determined> sweep() const { return sweeps_.least(); }

 private:
  struct Anchor {
    std::int64_t stamp;  // as it arrived [ns]
    geometry::Pose2 T_odom_sensor;
    std::vector<OrderedReturn> returns;
  };
  struct Turn {
    std::int64_t before;  // stamps as they arrived [ns]
    std::int64_t now;
    double turn;  // by the scans [rad]
    double late;  // of what it was seen by, after the middle of the sweep [s]
  };
  bool isFixed(const geometry::Pose2& T_base_sensor);
  bool isConsecutive(const Anchor& now) const;
  void measure(const scan::Scan& scan, const Anchor& now);
  void takeSeam(const std::vector<TurnResidual>& residuals, double rate);
  void compareWithOdometry();
  void compare(const Turn& turn);
  double firstOff() const;
  double duration() const { return true_sweep_.value_or(declared_); }
  void judgeSweep();
  void judgeMiddle();
  void correctSweep(scan::Scan& scan);

  DelayRegression middles_;
  CostProfile sweeps_;
  motion::PoseHistory path_;
  std::optional<geometry::Pose2> T_base_sensor_;
  std::optional<Anchor> anchor_;
  std::deque<Turn> turns_;  // that wait for the odometry of the times around them

  double period_ = 0.0;               // from scan to scan [s]
  double declared_ = 0.0;             // duration of the sweep as it arrives [s]
  std::optional<double> true_sweep_;  // where the declared one is wrong [s]
  double middle_off_ = 0.0;           // of the sweep, after where it is declared to be [s]
  double applied_ = 0.0;              // of firstOff(), so far [s]
  std::optional<std::int64_t> last_;  // stamp as it arrived [ns]
  std::shared_ptr<const scan::ScanGeometry> arrived_;  // that corrected_ was made of
  std::shared_ptr<const scan::ScanGeometry> corrected_;
};

}  // namespace sightline::pipeline
