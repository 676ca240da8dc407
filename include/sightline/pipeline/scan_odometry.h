#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/geometry/pose2.h"
#include "sightline/motion/floor_finder.h"
#include "sightline/pipeline/located_scan.h"
#include "sightline/pipeline/wheel_prior.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

struct ScanOdometryConfig {
  dead_reckoning::DeadReckonerConfig matching;
  WheelsConfig wheels;
  double turn_rate_sigma = 0.02;  ///< of a gyroscope [rad/s]

  void visit(config::FieldVisitor& visitor);
};

/// Odometry from scans, with what goes around the matching: the prior from wheels or a gyroscope,
/// which is left out of a step that no carrier makes or that the scans explain better without it,
/// and for a scanner that leans the beams that ended on floor or ceiling, which are left out.
///
/// Scans of several scanners, in the order of their stamps, make one odometry. Those of the first
/// alone are used where that order is not known, as stamps are those of arrival, and by methods
/// whose reference is one scan.
///
/// The frame odom is that of the wheels where they are known at the first scan, otherwise the
/// base's pose at that scan. Not thread-safe.
class ScanOdometry {
 public:
  /// Throws config::Error if the configuration is out of range.
  ///
  /// @param floor  of a scanner that leans: beams on floor or ceiling are looked for in scans that
  ///               bring no attitude
  explicit ScanOdometry(const ScanOdometryConfig& config,
                        const std::optional<motion::FloorConfig>& floor = {});

  /// Takes one scan; a sensor of unknown mounting is taken for the base. Nothing for one that is
  /// left out (whyNone). The update's `step` holds the turn between the scans, with its
  /// covariance, for others to use.
  std::optional<dead_reckoning::DeadReckoningUpdate> update(const LocatedScan& located);
  /// Why the last scan got no update.
  const std::string& whyNone() const { return why_none_; }
  /// Keeps what a scan that is not used tells of the time since the one before it.
  void passOver(const LocatedScan& located);
  /// Starts anew at the next scan.
  void reset();
  /// The clock was set. Where the wheels tell that the carrier is still there, the odometry goes on
  /// as if one more scan had come; otherwise it forgets the stamp of the last scan and keeps the
  /// pose.
  void restartClock() { clock_was_set_ = true; }

  /// Beams of the last scan that were found to be on floor or ceiling; empty where none were looked
  /// for.
  const std::vector<bool>& beamsOnFloor() const { return on_floor_; }

 private:
  struct Before {
    std::int64_t stamp = 0;
    std::size_t scanner = 0;
    std::optional<geometry::Pose2> T_path_base;  // by the wheels
    geometry::UncertainTwist2 twist;
  };
  /// Turn and breaks since the last scan that was used, as told with scans that were not.
  struct Passed {
    bool any = false;
    std::optional<double> turn = 0.0;  // nothing where one of them did not know it
    bool odometry_broke = false;
  };
  using Update = dead_reckoning::DeadReckoningUpdate;
  using Prior = std::optional<dead_reckoning::MotionPrior>;

  std::string faultOf(const LocatedScan& located);
  LocatedScan withPassed(const LocatedScan& located) const;
  std::optional<Update> updateInOrder(const LocatedScan& located);
  double elapsedOf(const LocatedScan& located) const;
  static const std::optional<geometry::Pose2>& pathOf(const LocatedScan& located);
  std::optional<Update> updateInTime(const LocatedScan& located);
  void goOnInNewTime(const LocatedScan& located);
  Prior priorOf(const LocatedScan& located) const;
  dead_reckoning::MotionPrior asBefore(double elapsed, double turn) const;
  bool isPossible(const geometry::Pose2& step, double elapsed) const;
  std::optional<dead_reckoning::Match> match(const scan::Scan& scan, const LocatedScan& located,
                                             const geometry::Pose2& T_base_sensor) const;
  std::optional<Update> matchLevel(const scan::Scan& scan, const LocatedScan& located,
                                   const geometry::Pose2& T_base_sensor);
  std::optional<Update> matchLeaning(const scan::Scan& scan, const LocatedScan& located,
                                     const geometry::Pose2& T_base_sensor);

  ScanOdometryConfig config_;
  dead_reckoning::DeadReckoner reckoner_;
  std::optional<motion::FloorConfig> floor_;
  std::map<std::size_t, motion::FloorFinder> finders_;  // of scanners that lean
  std::optional<Before> before_;
  std::optional<std::size_t> first_;  // scanner that came first
  std::set<std::size_t> in_bursts_;   // scanners whose last stamp was that of an arrival
  Passed passed_;
  std::string why_none_;
  bool is_new_ = true;
  bool clock_was_set_ = false;
  std::int64_t shift_ = 0;   // from the stamps to the time of the reckoner [ns]
  std::int64_t period_ = 0;  // between the last two scans [ns]
  std::vector<bool> on_floor_;
};

}  // namespace sightline::pipeline
