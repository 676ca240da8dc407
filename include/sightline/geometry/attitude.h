#pragma once

#include <Eigen/Core>

namespace sightline::geometry {

/// Inclination of a body, whatever its heading: turned about its x axis, then about the y axis of
/// the level frame that shares its heading [rad]. Positive pitch looks down, positive roll leans
/// right.
struct Attitude {
  double roll = 0.0;
  double pitch = 0.0;

  /// R_level_body: takes vectors of the body to the level frame with its heading.
  Eigen::Matrix3d rotation() const;
  /// Attitude of a rotation R_world_body, its heading left out.
  static Attitude of(const Eigen::Matrix3d& rotation);
  /// Attitude of a frame which sits on the body, turned by `yaw` [rad] about its z axis.
  Attitude seenFrom(double yaw) const;
};

}  // namespace sightline::geometry
