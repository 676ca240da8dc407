#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sightline/geometry/arc.h"
#include "sightline/geometry/feature.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/lines/plain_extractor.h"
#include "sightline/pipeline/estimators_config.h"
#include "sightline/pipeline/located_scan.h"
#include "sightline/pipeline/scan_features.h"
#include "sightline/tracking/room_tracker.h"

namespace sightline::pipeline {

/// Estimators that are to run.
struct EstimatorSet {
  bool lines = false;
  bool rooms = false;
  bool odometry = false;
  bool features = false;  ///< needs lines
};

/// Results of the estimators for one scan; nothing of those that do not run, or refused it.
/// Odometry comes from all scanners, but not from a frame of unknown mounting once a mounting has
/// been known.
struct Estimates {
  LocatedScan located;  ///< as the estimators saw it: without floor, motion filled in
  std::optional<Lines> lines;
  /// In the frame of the odometry, as of this scan; nothing where the motion of the base is
  /// unknown.
  std::optional<std::vector<geometry::Feature>> features;
  std::optional<tracking::TrackerUpdate> rooms;
  std::optional<dead_reckoning::DeadReckoningUpdate> odometry;
  std::string no_odometry;  ///< why there is none, where it runs
};

/// Runs the estimators on located scans and hands values from one to another: the floor that the
/// dead reckoner finds and the motion within the sweep that it knows, to lines and tracker, and its
/// pose to the tracker where the settings leave wheels out; lines to the features. No estimator
/// knows another. Not thread-safe.
class Estimators {
 public:
  /// Throws config::Error.
  Estimators(const EstimatorsConfig& config, const EstimatorSet& set);

  /// Takes scans in the order of the feed.
  Estimates take(LocatedScan located);

  /// Access for commands and settings from outside; null where that estimator does not run.
  tracking::RoomTracker* rooms() { return rooms_ ? &*rooms_ : nullptr; }
  ScanOdometry* odometry() { return set_.odometry ? &*odometry_ : nullptr; }
  /// Throws config::Error.
  void configureLines(const LinesConfig& config);

 private:
  struct Extractor {
    lines::LineExtractor full;
    lines::PlainExtractor plain;
  };

  void restartRooms(const geometry::Pose2& T_odom_base);
  std::optional<geometry::Pose2> odometryOf(const Estimates& estimates) const;
  void removeFloor(LocatedScan& located) const;
  bool isPlaced(const LocatedScan& located);
  void reckon(Estimates& estimates);
  void addMotion(Estimates& estimates) const;
  void extract(Estimates& estimates);
  void track(Estimates& estimates);
  Extractor& extractorOf(std::size_t scanner);

  EstimatorsConfig config_;
  EstimatorSet set_;
  std::vector<Extractor> extractors_;  // one a scanner, whose geometry it keeps
  std::optional<tracking::RoomTracker> rooms_;
  std::optional<ScanOdometry> odometry_;
  std::optional<ScanFeatures> features_;
  std::optional<geometry::Pose2> T_odom_base_;  // that rooms went by at the last scan
  bool rooms_restart_ = false;                  // the clock was set since that scan
  bool is_mounting_known_ = false;              // of a scan that the odometry took
  std::optional<std::size_t> taken_for_base_;   // scanner of unknown mounting
};

}  // namespace sightline::pipeline
