#pragma once

#include <optional>
#include <vector>

#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/gated_wall.h"
#include "sightline/tracking/plain_filter.h"
#include "sightline/tracking/tracking_context.h"

namespace sightline::tracking {

/// Pose tracking as jensfelt section 4 describes it and nothing else, for comparison: validation
/// gates, a range-weighted Hough transform for each wall alone, a second validation, least squares
/// with the same noise for every point, additive prediction, a floor on the uncertainty. The map
/// is exact, and only the walls of the room that the robot is in are looked for. Its covariance is
/// not to be believed.
///
/// Differs from the paper where that would not work: rooms may stand at any angle and have any
/// number of walls, and the laser may stand anywhere on the robot.
class PlainTracker {
 public:
  PlainTracker(const TrackingContext& context, const geometry::UncertainPose2& start,
               std::size_t room);

  /// Takes one scan. Returns nothing for a scan older than the last one used.
  std::optional<TrackerUpdate> update(const TrackingContext& context, const TrackerInput& input);
  /// Adds to the standard deviations (jensfelt section 5.2: by hand) [m, rad].
  void inflate(double position_sigma, double heading_sigma);
  geometry::UncertainPose2 pose() const { return filter_.pose(); }
  std::size_t room() const { return memory_.room(); }
  void setRoom(std::size_t room) { memory_.setRoom(room); }
  void restartClock() { memory_.restartClock(); }

 private:
  PlainFilter filter_;
  TrackMemory memory_;
};

/// The walls of a room in a scan, by gate, transform, second gate and least squares over the points
/// near each peak (jensfelt section 4.2).
std::vector<WallFit> findPlainly(const TrackerConfig& config, const PlainFilter& predicted,
                                 const world::Room& room, const Sweep& sweep);

}  // namespace sightline::tracking
