#pragma once

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"

namespace sightline::geometry {

/// A directed straight piece between two points [m].
struct Segment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();

  double length() const { return (end - start).norm(); }
  Eigen::Vector2d midpoint() const { return 0.5 * (start + end); }
  /// Unit vector from start to end.
  Eigen::Vector2d direction() const { return (end - start).normalized(); }
  /// Unit normal on the left of the direction: the inside of a room whose walls run
  /// counter-clockwise.
  Eigen::Vector2d leftNormal() const;
  /// The infinite line, with zero covariance.
  PolarLine line() const;
  /// Distance of a point from the nearest point of the segment.
  double distance(const Eigen::Vector2d& point) const;
  /// Position of the projection of a point, metres from the start along the direction; may lie
  /// outside [0, length].
  double along(const Eigen::Vector2d& point) const { return direction().dot(point - start); }
};

inline Segment operator*(const Pose2& T_target_source, const Segment& segment_source) {
  return {T_target_source * segment_source.start, T_target_source * segment_source.end};
}

}  // namespace sightline::geometry
