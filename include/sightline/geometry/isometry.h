#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "sightline/geometry/pose2.h"

namespace sightline::geometry {

/// Position and heading of the x axis, seen from above. This holds for a frame upside down too: its
/// x axis keeps its heading.
inline Pose2 inPlane(const Eigen::Isometry3d& transform) {
  const Eigen::Matrix3d& R = transform.linear();
  return {transform.translation().x(), transform.translation().y(), std::atan2(R(1, 0), R(0, 0))};
}

/// The pose at height zero.
inline Eigen::Isometry3d inSpace(const Pose2& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear().topLeftCorner<2, 2>() = pose.rotation();
  result.translation().head<2>() = pose.translation();
  return result;
}

}  // namespace sightline::geometry
