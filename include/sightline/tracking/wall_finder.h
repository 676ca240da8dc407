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

  /// Lines in the gate of a wall that may be it.
  enum class Lines { kHeaviest, kAll };

  /// One result for each wall asked for, in their order. With all lines in question, several such
  /// lists where the pose leaves open which of several lines is a wall, and the heaviest lines
  /// contradict each other: by those, then one for each choice in which the walls agree.
  std::vector<std::vector<WallFit>> find(const PoseFilter& predicted, const world::RoomMap& map,
                                         const std::vector<world::WallIndex>& walls,
                                         const Sweep& sweep, Lines lines = Lines::kAll) const;

 private:
  using Walls = std::vector<const world::Wall*>;
  // What has been looked for, and where.
  struct Question {
    Walls walls;
    std::vector<double> sigmas;
    std::vector<GatedWall> gated;
  };
  // A choice of lines for walls, and the pose by them.
  struct Choice {
    PoseFilter filter;
    double score = 0.0;
  };
  struct Heaviest {
    PoseFilter filter;
    bool is_contradictory;
  };
  bool isSeen(const GatedWall& gated, const std::vector<WallPeak>& peaks) const;
  bool isOpen(const GatedWall& gated, const std::vector<WallPeak>& peaks) const;
  Heaviest heaviest(const PoseFilter& predicted, const Question& question,
                    const HoughPeaks& peaks) const;
  std::vector<Choice> chooseByHough(const PoseFilter& predicted, const Question& question,
                                    Lines lines) const;
  std::vector<Choice> chosenFurther(const std::vector<Choice>& choices, const GatedWall& gated,
                                    const std::vector<WallPeak>& peaks,
                                    const world::Wall& wall) const;
  std::vector<WallFit> fitFrom(const PoseFilter& refined, const Question& question,
                               const std::vector<world::WallIndex>& indices,
                               const Sweep& sweep) const;
  void fitWall(const GatedWall& gated, const world::Wall& wall, const geometry::Pose2& T_base_map,
               const Sweep& sweep, WallFit& result) const;
  static void addMapUncertainty(const WallConfig& known,
                                const std::vector<const BeamPoint*>& points,
                                geometry::PolarLine& line);

  GateConfig gate_;
  WallConfig wall_;
  RangeWeightedHough hough_;
};

}  // namespace sightline::tracking
