#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sightline/geometry/arc.h"
#include "sightline/geometry/feature.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/lines/carrier_step.h"
#include "sightline/lines/feature_track.h"
#include "sightline/lines/feature_tracker_config.h"
#include "sightline/lines/sighting.h"
#include "sightline/lines/wall_identities.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// What the extractor found in a scan, and how the scanner came there.
struct ObservedLines {
  const scan::Scan& scan;
  std::vector<geometry::LineSegment>& segments;  ///< their ids are filled in
  std::vector<geometry::Arc>& arcs;              ///< the same
  CarrierStep step;                              ///< of the base since the scan before
  geometry::Pose2 T_base_sensor;
};

/// Follows corners, edges, ends of lines and round things over scans, and tells by how they behave
/// while the carrier moves which are fixed, which slide along a wall with the viewpoint, and which
/// move by themselves (pears section 4: discontinuities that do not exhibit predictable behaviour).
///
/// Each feature is filtered under the three assumptions at once; the sightings weigh them against
/// each other. Features are held relative to the base, where the errors of the odometry, its
/// constant scale among them, are those of the steps since they were seen. What the beams say of an
/// end between two of them errs alike while they fall on the same places, and counts once.
///
/// Not thread-safe. Ids are never given twice.
class FeatureTracker {
 public:
  /// Throws config::Error where a setting is out of range.
  explicit FeatureTracker(const FeatureTrackerConfig& config = {});
  // The tracks refer to its settings.
  FeatureTracker(const FeatureTracker&) = delete;
  FeatureTracker& operator=(const FeatureTracker&) = delete;

  /// Takes a scan. A stamp before that of the last one counts as the same time.
  void update(const ObservedLines& observed);
  /// The odometry broke, or its step is not known: adds to the uncertainty [m, rad].
  void inflate(double position_sigma, double heading_sigma);
  /// Forgets all features: the clock was set, and what they did meanwhile is not known.
  void restart();

  /// Features in a frame that the base was at `T_odom_base` in at the last scan, by id.
  std::vector<geometry::Feature> features(const geometry::Pose2& T_odom_base) const;
  std::size_t size() const { return tracks_.size(); }
  const FeatureTrackerConfig& config() const { return config_; }

 private:
  struct Pair {
    std::size_t track;
    std::size_t sighting;
    double density;
  };
  double elapsedTo(std::int64_t stamp);
  void predict(const ObservedLines& observed, double elapsed);
  ViewChange viewChange(const FeatureTrack& track, const ObservedLines& observed,
                        double elapsed) const;
  std::vector<Pair> pairs(const std::vector<Sighting>& sightings) const;
  void assign(const std::vector<Sighting>& sightings, const ObservedLines& observed,
              double elapsed);
  void missUnseen(const ObservedLines& observed, double elapsed);
  void unite();
  void forget();

  FeatureTrackerConfig config_;
  WallIdentities walls_;
  std::vector<FeatureTrack> tracks_;  // by id
  std::uint32_t last_id_ = 0;
  std::optional<std::int64_t> stamp_;  // of the last scan
  geometry::Pose2 T_base_sensor_;      // at the last scan
};

}  // namespace sightline::lines
