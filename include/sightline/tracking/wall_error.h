#pragma once

#include <Eigen/Core>

#include "sightline/tracking/tracker_config.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Error of a wall of the map as a constant that is considered but not estimated (Schmidt 1966):
/// the offset of its middle along its normal [m] and the turn about its middle [rad].
struct WallError {
  world::WallIndex wall;
  /// ∂(ρ, φ) of the wall's line in the map / ∂(offset, turn).
  Eigen::Matrix2d line_jacobian = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  WallError() = default;
  WallError(const world::WallIndex& index, const geometry::Segment& segment_map,
            const WallConfig& config);
};

}  // namespace sightline::tracking
