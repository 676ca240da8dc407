#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"

namespace sightline::tracking {

/// Where a wall is looked for (jensfelt fig. 4): around the predicted wall, half as wide as
/// `opening` at the foot of the sensor's perpendicular and widening by `angle` to both sides along
/// it.
struct GateSize {
  double opening = 0.0;  ///< δ [m], half width
  double angle = 0.0;    ///< γ [rad]
};

/// What one wall gave to one update.
struct WallObservation {
  std::size_t room = 0;
  std::size_t wall = 0;
  GateSize gate;
  std::size_t beams_in_gate = 0;
  std::vector<std::size_t> accepted_beams;  ///< that the line was fitted to
  bool accepted = false;                    ///< whether it updated the pose
  geometry::PolarLine fit;                  ///< in the base frame, where any
  /// ∂(ρ, φ)fit / ∂(motion from the first beam to the last, in coordinates of the base frame).
  Eigen::Matrix<double, 2, 3> motion_jacobian = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Vector2d innovation =
      Eigen::Vector2d::Zero();  ///< (ρ, φ) measured less predicted [m, rad]
  double nis = 0.0;             ///< normalised innovation squared, 2 degrees of freedom
};

}  // namespace sightline::tracking
