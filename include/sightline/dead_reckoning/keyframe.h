#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/range_profile.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// A small straight piece of a surface, in the frame odom.
struct Surfel {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();    ///< unit, to the side it was seen from
  double normal_variance = 0.0;                        ///< of its direction [rad²]
  double reach = 0.0;                                  ///< half length [m]
};

/// A scan of the reference.
struct Keyframe {
  std::size_t scanner = 0;  // that took it
  geometry::Pose2 T_odom_base;
  Eigen::Matrix2d R_base_odom;
  std::vector<SurfacePoint> points;  // in its base
  RangeProfile profile;              // in its base
  std::vector<Surfel> surfels;
  int agreeing = 0;       // keyframes that saw the same as it
  int contradicting = 0;  // keyframes that it cannot be where it is put with

  /// Whether it was put where it was not taken, as far as the others tell.
  bool isMisplaced() const { return contradicting >= 2 && contradicting > 2 * agreeing; }
};

/// Compares two keyframes of one scanner, and counts what it finds in both: whether each sees
/// surfaces where the other sees them, or looks through them. Those that hardly saw the same places
/// say nothing of each other.
void compare(Keyframe& a, Keyframe& b);

}  // namespace sightline::dead_reckoning
