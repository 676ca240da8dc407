#pragma once

#include <Eigen/Core>

#include "sightline/geometry/angle.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Difference of the coordinates (x, y, θ) of two poses, the angle wrapped.
inline Eigen::Vector3d difference(const geometry::Pose2& a, const geometry::Pose2& b) {
  Eigen::Vector3d off = a.coordinates() - b.coordinates();
  off[2] = geometry::wrapAngle(off[2]);
  return off;
}

}  // namespace sightline::dead_reckoning
