#pragma once

#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/grid_map.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Where the surface of a wall is taken to be in the first occupied cell, from its free edge
/// inwards, in cells. Half a cell: those who draw grids mark the cell in which a wall is.
constexpr double kMiddleOfCell = 0.5;

/// A grid as it is seen from places all over its free floor, and a path that visits them: what a
/// recording would have shown. Poses are exact, T_map_base.
struct GridSurvey {
  std::vector<KeyScan> keys;
  std::vector<geometry::Pose2> poses;  ///< of the key scans
  /// Through every room and door that a robot fits through; between floors that nothing joins,
  /// time passes.
  std::vector<geometry::StampedPose2> path;
  double cell = 0.0;  ///< [m]
};

/// @param surface  see kMiddleOfCell; from 0, the edge, to 1
/// Throws config::Error where the free floor has no room for a robot.
GridSurvey surveyGrid(const GridMap& map, double surface);

}  // namespace sightline::mapping
