#pragma once

#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Poses of the base within these distances of a centre.
struct SearchWindow {
  geometry::Pose2 centre;  ///< T_odom_base
  double position = 0.0;   ///< half side of the square, along the axes of odom [m]
  double heading = 0.0;    ///< half width [rad]

  bool isWithin(double most_position, double most_heading) const {
    return position < most_position && heading < most_heading;
  }
};

}  // namespace sightline::dead_reckoning
