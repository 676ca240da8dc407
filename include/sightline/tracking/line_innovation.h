#pragma once

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"
#include "sightline/geometry/pose2.h"

namespace sightline::tracking {

/// A measured line of the base frame against its wall in the map, seen from a pose, first order
/// (jensfelt eqs 6 and 9, for walls of any direction).
struct LineInnovation {
  Eigen::Vector2d value;                      ///< (ρ, φ) measured less predicted, heading wrapped
  Eigen::Matrix2d noise;                      ///< covariance of the measured line
  Eigen::Matrix<double, 2, 3> pose_jacobian;  ///< ∂ predicted / ∂(x, y, θ) of T_map_base
  /// −1 for ρ where the line is described by the normal opposite to the measured one's.
  Eigen::Vector2d sense;
};

LineInnovation compareLines(const geometry::Pose2& T_map_base,
                            const geometry::PolarLine& measured_base,
                            const geometry::PolarLine& wall_map);

}  // namespace sightline::tracking
