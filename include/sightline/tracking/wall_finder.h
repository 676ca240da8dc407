#pragma once

#include <vector>

#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/gated_wall.h"
#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/range_weighted_hough.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/wall_fit.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Finds walls of a map in a scan: jensfelt section 4.2 and fig. 3, from gates to wall hypotheses.
class WallFinder {
 public:
  explicit WallFinder(const TrackerConfig& config)
      : gate_(config.gate), wall_(config.wall), hough_(config.hough) {}

  /// One result for each wall asked for, in their order.
  std::vector<WallFit> find(const PoseFilter& predicted, const world::RoomMap& map,
                            const std::vector<world::WallIndex>& walls, const Sweep& sweep) const;

 private:
  using Walls = std::vector<const world::Wall*>;
  PoseFilter refineByHough(const PoseFilter& predicted, const Walls& walls,
                           const std::vector<GatedWall>& gated) const;
  void fitWall(const GatedWall& gated, const world::Wall& wall, const geometry::Pose2& T_base_map,
               const Eigen::Matrix3d& walk, WallFit& result) const;
  static void addMapUncertainty(const WallConfig& known,
                                const std::vector<const BeamPoint*>& points,
                                geometry::PolarLine& line);

  GateConfig gate_;
  WallConfig wall_;
  RangeWeightedHough hough_;
};

}  // namespace sightline::tracking
