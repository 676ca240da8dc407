#pragma once

#include <vector>

#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/range_weighted_hough.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/wall_observation.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Finds the walls of one room in a scan: jensfelt section 4.2 and fig. 3, from gates to wall hypotheses.
class WallFinder {
 public:
  explicit WallFinder(const TrackerConfig& config) : config_(config), hough_(config.hough) {}

  /// One observation for each wall of the room, those without a fit not `accepted`. Innovation and NIS are left to the
  /// filter. `room` is the index of the room in the map.
  std::vector<WallObservation> find(const PoseFilter& predicted, const world::RoomMap& map,
                                    std::size_t room, const std::vector<BeamPoint>& points) const;

 private:
  PoseFilter refineByHough(const PoseFilter& predicted, const world::Room& room,
                           const std::vector<GatedWall>& walls) const;
  std::vector<GatedWall> gate(const PoseFilter& filter, const world::Room& room,
                              const std::vector<BeamPoint>& points) const;
  void fitWall(const GatedWall& gated, const world::Wall& wall, const geometry::Pose2& T_base_map,
               WallObservation& observation) const;
  std::vector<const BeamPoint*> nearLine(const std::vector<const BeamPoint*>& points,
                                         const geometry::PolarLine& line, double slack) const;
  bool isEnough(const std::vector<const BeamPoint*>& points,
                const geometry::PolarLine& line) const;
  void addMapUncertainty(const std::vector<const BeamPoint*>& points,
                         geometry::PolarLine& line) const;

  TrackerConfig config_;
  RangeWeightedHough hough_;
};

}  // namespace sightline::tracking
