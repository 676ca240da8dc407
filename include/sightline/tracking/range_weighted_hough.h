#pragma once

#include <optional>
#include <vector>

#include "sightline/tracking/gated_wall.h"
#include "sightline/tracking/tracker_config.h"

namespace sightline::tracking {

/// Place where the transform found a wall, against the prediction.
struct WallPeak {
  double turn = 0.0;          ///< Δφ [rad]
  double distance = 0.0;      ///< Δρ [m]
  double weight = 0.0;        ///< sum of the ranges of the beams that voted for it [m]
  double turn_bin = 0.0;      ///< resolution of the transform [rad]
  double distance_bin = 0.0;  ///< [m]
};

struct HoughPeaks {
  double turn = 0.0;  ///< Δφ, one for all walls [rad]
  /// Peaks at that turn of each wall handed in, the heaviest first: a wall and what stands along it
  /// are peaks of one gate.
  std::vector<std::vector<WallPeak>> walls;
};

/// Bins between two peaks of one wall, at least: nearer ones are one wall that is uneven.
constexpr int kBinsApart = 3;

/// Local range-weighted Hough transform inside the gates (jensfelt section 4.2, after Forsberg et
/// al.): each beam votes with its range for every line through it, since near beams lie closer
/// together. However fine the bins are asked for, a gate holds no more than 200 in either
/// direction: then they are wider.
class RangeWeightedHough {
 public:
  explicit RangeWeightedHough(const HoughConfig& config) : config_(config) {}

  /// The walls turn with the robot, all by the same angle: the turn is the one at which the walls'
  /// best peaks together weigh most. Between peaks that weigh alike, the prediction decides.
  HoughPeaks transform(const std::vector<GatedWall>& walls) const;
  /// The heaviest peak of one wall alone, as in the paper.
  std::optional<WallPeak> heaviest(const GatedWall& wall) const;

 private:
  HoughConfig config_;
};

/// The line that a peak stands for, in the base frame, as uncertain as a bin is wide.
geometry::PolarLine lineAt(const WallPeak& peak, const geometry::PolarLine& predicted);

}  // namespace sightline::tracking
