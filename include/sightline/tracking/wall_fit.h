#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"
#include "sightline/tracking/sweep_error.h"

namespace sightline::tracking {

/// Size of the region in which a wall is looked for (jensfelt fig. 4): around the predicted wall,
/// half as wide as `opening` at the foot of the sensor's perpendicular and widening by `angle` to
/// both sides along it.
struct GateSize {
  double opening = 0.0;  ///< δ [m], half width
  double angle = 0.0;    ///< γ [rad]
};

/// Reason why a wall did not correct the pose.
enum class WallRefusal {
  kNone,          ///< it did
  kTooFewBeams,   ///< fewer beams in its gate, or near the line, than make a wall
  kTooShort,      ///< the beams cover too short a stretch
  kUndetermined,  ///< the beams do not determine a line
  kOutsideGate,   ///< its normalised innovation squared is too large
};

/// A line fitted to the beams that met a wall.
struct FittedLine {
  geometry::PolarLine line;                 ///< in the base frame
  std::vector<std::size_t> accepted_beams;  ///< that it was fitted to
  LineBySweepError motion_jacobian = LineBySweepError::Zero();
};

/// Findings on one wall in one scan.
struct WallFit {
  std::size_t room = 0;
  std::size_t wall = 0;
  GateSize gate;
  std::size_t beams_in_gate = 0;
  std::optional<FittedLine> fit;
  WallRefusal refusal = WallRefusal::kTooFewBeams;  ///< why there is no fit; kNone where there is

  std::size_t acceptedBeams() const { return fit ? fit->accepted_beams.size() : 0; }
};

/// Difference between a fitted line and the prediction from the pose.
struct WallInnovation {
  Eigen::Vector2d value;  ///< (ρ, φ) measured less predicted [m, rad]
  double nis = 0.0;       ///< normalised innovation squared, 2 degrees of freedom
};

/// Effect of one wall on one estimate of the pose.
struct WallUpdate : WallFit {
  std::optional<WallInnovation> innovation;  ///< where there is a fit

  WallUpdate() = default;
  explicit WallUpdate(WallFit found) : WallFit(std::move(found)) {}
  /// Whether it corrected the pose.
  bool accepted() const { return refusal == WallRefusal::kNone; }
};

}  // namespace sightline::tracking
