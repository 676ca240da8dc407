#pragma once

#include <optional>
#include <vector>

#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/geometry/arc.h"
#include "sightline/geometry/feature.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/lines/feature_tracker.h"
#include "sightline/pipeline/located_scan.h"

namespace sightline::pipeline {

/// Lines of one scan, in the scan's frame, level and the right way up.
struct Lines {
  std::vector<geometry::LineSegment> segments;
  std::vector<geometry::Arc> arcs;
};

/// Features over located scans. The motion from scan to scan is that of the wheels, or of the dead
/// reckoner where there are none.
class ScanFeatures {
 public:
  /// Throws config::Error.
  explicit ScanFeatures(const lines::FeatureTrackerConfig& config) : tracker_(config) {}

  /// Fills in the ids of the lines, and returns the features in the frame of the odometry; nothing
  /// where the motion of the base, or where the sensor sits on it, is not known.
  std::optional<std::vector<geometry::Feature>> take(
      const LocatedScan& located,
      const std::optional<dead_reckoning::DeadReckoningUpdate>& odometry, Lines& lines);
  /// The clock was set.
  void restart();

 private:
  // Poses of the base at one scan: in a frame without breaks, and in that of the odometry.
  struct Place {
    bool by_wheels = false;
    geometry::UncertainPose2 T_path_base;
    geometry::Pose2 T_odom_base;
  };
  static std::optional<Place> placeOf(
      const LocatedScan& located,
      const std::optional<dead_reckoning::DeadReckoningUpdate>& odometry);
  lines::CarrierStep stepTo(const Place& place) const;

  lines::FeatureTracker tracker_;
  std::optional<Place> before_;
};

}  // namespace sightline::pipeline
