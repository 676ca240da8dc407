#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "sightline/targets/bearing_set.h"
#include "sightline/targets/sensor_model.h"

namespace sightline::test {

/// A set of bearings from a pose that is known exactly, at a time [s].
inline targets::BearingSet lookFrom(const geometry::Pose2& pose, std::vector<double> bearings,
                                    double time = 0.0) {
  targets::BearingSet set;
  set.T_map_sensor.mean = pose;
  set.bearings = std::move(bearings);
  set.stamp = std::llround(1e9 * time);
  return set;
}

inline double bearingOf(const Eigen::Vector2d& point, const geometry::Pose2& pose) {
  return targets::polarOf(pose.inverse() * point).bearing;
}

}  // namespace sightline::test
