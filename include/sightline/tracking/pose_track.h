#pragma once

#include <optional>
#include <vector>

#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/tracking_context.h"
#include "sightline/tracking/wall_finder.h"

namespace sightline::tracking {

/// One hypothesis of where the robot is, by the method full: filter, room and what it remembers of
/// the scans before. A value: copies are independent, so that rivals are a vector of these. What
/// all rivals share is handed in as context.
class PoseTrack {
 public:
  PoseTrack(const TrackingContext& context, const geometry::UncertainPose2& start,
            std::size_t room);

  /// One way of explaining a scan: the pose before it, corrected by the walls found from there.
  struct Explanation {
    PoseFilter filter;
    std::vector<WallUpdate> walls;
    ScanAgreement agreement;
  };
  /// Moves with the odometry to the stamp of a scan.
  void predict(const TrackingContext& context, const TrackerInput& input);
  /// The scan as predicted, or as after a slip of the wheels where that agrees better.
  Explanation explain(const TrackingContext& context, const TrackerInput& input) const;
  /// Takes an explanation for the truth, and goes into the next room where it leads there.
  TrackerUpdate commit(const TrackingContext& context, const TrackerInput& input,
                       Explanation explanation);

  /// The three in turn. Nothing for a scan older than the last one used.
  std::optional<TrackerUpdate> update(const TrackingContext& context, const TrackerInput& input);
  /// Adds an independent error of these standard deviations [m, rad].
  void inflate(double position_sigma, double heading_sigma);
  geometry::UncertainPose2 pose() const { return filter_.pose(); }
  TrackMemory& memory() { return memory_; }

 private:
  Explanation explainFrom(const PoseFilter& prior, const TrackingContext& context,
                          const TrackerInput& input, const Sweep& sweep) const;

  PoseFilter filter_;
  TrackMemory memory_;
};

}  // namespace sightline::tracking
