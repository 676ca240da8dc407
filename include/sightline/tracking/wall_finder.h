#pragma once

#include <vector>

#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/range_weighted_hough.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/wall_observation.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// A wall of the map by its place there.
struct WallIndex {
  std::size_t room = 0;
  std::size_t wall = 0;
};

/// Finds walls of a map in a scan: jensfelt section 4.2 and fig. 3, from gates to wall hypotheses.
class WallFinder {
 public:
  explicit WallFinder(const TrackerConfig& config) : config_(config), hough_(config.hough) {}

  /// One observation for each wall asked for, those without a fit not `accepted`. Innovation and
  /// NIS are left to the filter.
  std::vector<WallObservation> find(const PoseFilter& predicted, const world::RoomMap& map,
                                    const std::vector<WallIndex>& walls, const Sweep& sweep) const;

 private:
  using Walls = std::vector<const world::Wall*>;
  PoseFilter refineByHough(const PoseFilter& predicted, const Walls& walls,
                           const std::vector<GatedWall>& gated) const;
  std::vector<GatedWall> gate(const PoseFilter& filter, const Walls& walls,
                              const std::vector<BeamPoint>& points) const;
  void fitWall(const GatedWall& gated, const world::Wall& wall, const geometry::Pose2& T_base_map,
               WallObservation& observation) const;
  std::vector<const BeamPoint*> nearLine(const std::vector<const BeamPoint*>& points,
                                         const geometry::PolarLine& line, double slack) const;
  bool isEnough(const std::vector<const BeamPoint*>& points, const geometry::PolarLine& line) const;
  void addMapUncertainty(const std::vector<const BeamPoint*>& points,
                         geometry::PolarLine& line) const;

  TrackerConfig config_;
  RangeWeightedHough hough_;
};

}  // namespace sightline::tracking
