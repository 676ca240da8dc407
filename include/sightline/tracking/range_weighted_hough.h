#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/validation_gate.h"

namespace sightline::tracking {

/// The validated beams of one wall.
struct GatedWall {
  ValidationGate gate;
  std::vector<const BeamPoint*> points;
};

/// Where the transform found a wall, against where it was predicted.
struct WallPeak {
  double distance = 0.0;  ///< Δρ [m]
  double weight = 0.0;    ///< sum of the ranges of the beams that voted for it [m]
};

struct HoughPeaks {
  double turn = 0.0;  ///< Δφ, one for all walls [rad]
  std::vector<std::optional<WallPeak>>
      walls;  ///< one for each wall handed in; nothing where no beam voted
};

/// Local range-weighted Hough transform inside the gates (jensfelt section 4.2, after Forsberg et
/// al.): each beam votes with its range for every line through it, since near beams lie closer
/// together. The walls turn with the robot, all by the same angle: the turn is the one at which the
/// walls' best peaks together weigh most.
class RangeWeightedHough {
 public:
  explicit RangeWeightedHough(const HoughConfig& config) : config_(config) {}

  HoughPeaks transform(const std::vector<GatedWall>& walls) const;

 private:
  std::vector<double> vote(const GatedWall& wall, double turn) const;
  std::optional<WallPeak> bestPeak(const GatedWall& wall, double turn) const;

  HoughConfig config_;
};

}  // namespace sightline::tracking
