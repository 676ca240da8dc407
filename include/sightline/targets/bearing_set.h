#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/targets/sensor_model_config.h"

namespace sightline::targets {

/// A point of the map and its covariance [m, m²].
struct UncertainPoint {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// A robot of the team whose pose has not come for a while: it is somewhere about where it was.
struct LostMate {
  std::size_t robot = 0;
  UncertainPoint last;     ///< where it was
  std::int64_t stamp = 0;  ///< at that time [ns]
};

/// What one robot saw in one look: bearings [rad] in the sensor frame, none where it saw nothing.
struct BearingSet {
  std::size_t robot = 0;                  ///< counts from 0
  std::int64_t stamp = 0;                 ///< [ns]
  geometry::UncertainPose2 T_map_sensor;  ///< its error is common to all bearings of the look
  double turn_rate = 0.0;                 ///< of the sensor just before; 0 where unknown [rad/s]
  std::vector<double> bearings;
  FieldOfView field_of_view{-geometry::kPi, geometry::kPi};
  double sigma = 0.0;                 ///< of a bearing as the detector states it; 0: unknown [rad]
  double range_max = 1e9;             ///< [m]
  std::vector<UncertainPoint> known;  ///< things that are no targets and seen like these: robots
  std::vector<LostMate> lost;         ///< other ones, whose places are not known
};

}  // namespace sightline::targets
