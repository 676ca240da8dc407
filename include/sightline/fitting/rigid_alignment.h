#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"

namespace sightline::fitting {

/// The same place, seen from two frames [m].
struct PointPair {
  Eigen::Vector2d target;
  Eigen::Vector2d source;
};

/// The T_target_source that minimises Σ |target − T source|², in closed form: both centroids
/// coincide, and the heading is the angle of the summed products (algorithm 3 of saarinen). Nothing
/// where fewer than two pairs, or points in one place, leave the heading open.
std::optional<geometry::Pose2> alignPoints(const std::vector<PointPair>& pairs);

}  // namespace sightline::fitting
