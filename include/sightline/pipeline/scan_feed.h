#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sightline/pipeline/repeat_watch.h"
#include "sightline/pipeline/scan_clock.h"
#include "sightline/pipeline/scan_locator.h"
#include "sightline/pipeline/scan_schedule.h"
#include "sightline/pipeline/stamp_watch.h"
#include "sightline/pipeline/sweep_timing.h"
#include "sightline/pipeline/turn_sense.h"
#include "sightline/scan/learned_noise.h"
#include "sightline/scan/miss_value.h"
#include "sightline/scan/turn_gatherer.h"

namespace sightline::pipeline {

/// Outcome for one scan.
struct FeedResult {
  std::size_t scanner = 0;
  std::int64_t stamp = 0;              ///< [ns]
  std::optional<LocatedScan> located;  ///< nothing where it was dropped
  std::string reason;                  ///< why it was dropped
};

/// Counts of the scans of one scanner, by outcome. Partial sweeps count as the turn they make.
struct FeedCounts {
  std::size_t arrived = 0;
  std::size_t located = 0;
  std::size_t odometry_broke = 0;  ///< located, after a break in the odometry
  std::size_t turns_opposite = 0;  ///< located, while turns are opposite to the odometry's
  std::size_t without_motion = 0;  ///< located, but the motion within the sweep is not known
  std::map<std::string, std::size_t> dropped;  ///< by reason
};

/// Takes scans as they arrive and gives them back, those that wait in the order of their stamps and
/// each scanner's own always so, completed by transforms, odometry and an inertial sensor, or with
/// the reason why it is not used. A scan waits for what belongs to it as long as the settings'
/// patience lasts. A scanner whose stamps are those of arrival keeps the order of arrival. A
/// scan also waits for one of another scanner that is about to come late with an earlier stamp.
///
/// A stamp that leaps against the ones before it is left out, unless those after it go on from
/// there: then the clock was set, and the scans of the new time are used.
///
/// Live nodes, recordings and tests use this class alike, with a clock of their own: `now` is any
/// time that goes on evenly [ns]. Not thread-safe.
class ScanFeed {
 public:
  /// The transforms have to live as long. Throws config::Error.
  ScanFeed(const FeedConfig& config, const Frames& frames, const FeedNeeds& needs,
           const Transforms& transforms);

  /// Returns the scanner's number, from 0 on.
  std::size_t addScanner();
  /// A scan gets its variances by the settings' noise model, or by what this scanner's scans have
  /// shown (NoiseKind::kEstimated); a range scan brings its own.
  void add(std::size_t scanner, scan::Scan scan, std::int64_t now);
  void add(std::size_t scanner, motion::RangeScan range_scan, std::int64_t now);
  /// Counts a message that is no scan.
  void refuse(std::size_t scanner, const std::string& reason);
  /// Both return why a reading is left out; an empty text where it is used.
  std::string addOdometry(std::int64_t stamp, const geometry::Pose2& T_odom_base, std::int64_t now);
  std::string addImu(const ImuReading& reading, std::int64_t now);

  /// The next scan that is settled; nothing where there is none, or it may wait.
  std::optional<FeedResult> next(std::int64_t now);
  /// Whether scans wait for what belongs to them: next() has to be asked again as time goes on.
  bool isWaiting() const { return !waiting_.empty(); }
  /// The next scan where nothing more will come.
  std::optional<FeedResult> flush();

  const FeedCounts& counts(std::size_t scanner) const { return scanners_[scanner].counts; }
  /// Noise of a scanner, where that is learned from its scans; null where the settings say it.
  const scan::RangeNoise* learnedNoise(std::size_t scanner) const;
  /// What is wrong with the times of a scanner's beams, in words; empty where nothing is.
  std::string timingFault(std::size_t scanner) const;
  std::size_t scanners() const { return scanners_.size(); }

 private:
  struct Scanner {
    FeedCounts counts;
    StampWatch stamps;
    std::vector<ArrivedScan> strays;  // whose stamps may be those of a new time
    scan::TurnGatherer turns;
    scan::MissValue misses;
    scan::LearnedNoise noise;
    ScanClock clock;
    ScanSchedule schedule;
    RepeatWatch repeats;
    TurnSense sense;
    SweepTiming timing;
    double skipped = 0.0;  // time of scans that were dropped since the last one, by the clock [s]
    std::optional<std::int64_t> before;  // stamp of its last scan that was located
  };

  void admit(ArrivedScan arrived);
  void dropStrays(Scanner& scanner);
  void take(ArrivedScan arrived);
  void enqueue(ArrivedScan arrived);
  bool isOnlyLate(const ArrivedScan& arrived) const;
  bool isPreceded(const ArrivedScan& arrived, std::int64_t now) const;
  bool goesBefore(const ArrivedScan& arrived, const ArrivedScan& other) const;
  std::optional<FeedResult> nextDropped();
  std::optional<FeedResult> settle(const Patience& patience);
  FeedResult finish(const ArrivedScan& arrived, ScanLocator::Outcome outcome);
  bool isRepeat(const LocatedScan& located);
  void watchTurns(const ArrivedScan& arrived, LocatedScan& located);
  FeedResult drop(const ArrivedScan& arrived, const std::string& reason);
  bool isSetBack(const ArrivedScan& arrived) const;

  FeedConfig config_;
  FeedNeeds needs_;
  ScanLocator locator_;
  StampWatch odometry_stamps_;
  StampWatch imu_stamps_;
  std::vector<Scanner> scanners_;
  std::deque<FeedResult> dropped_;      // before they came to wait
  std::deque<ArrivedScan> waiting_;     // in the order of their stamps
  std::optional<std::int64_t> newest_;  // stamp of the newest scan that was located
  std::optional<std::int64_t> last_;    // stamp of the last one
  bool clock_restarted_ = false;        // and no scan has been located since
  bool odometry_broke_ = false;         // before a scan that was dropped
  double heading_ = 0.0;                // by the gyroscope [rad]
};

}  // namespace sightline::pipeline
