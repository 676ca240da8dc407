#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Pose of one key scan seen from another, by matching them.
struct Relation {
  std::size_t from = 0;  ///< key scan
  std::size_t to = 0;    ///< key scan
  geometry::Pose2 T_from_to;
  /// Information about the coordinates of T_from_to, by the scans alone; singular where they do not
  /// tell.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  bool is_loop = false;  ///< whether it joins two visits of a place
};

/// Poses of the key scans, T_map_base, and what was learned with them.
struct GraphSolution {
  std::vector<geometry::Pose2> poses;
  double wheel_scale = 1.0;           ///< true length over that which the wheels tell
  double wheel_turn = 0.0;            ///< what the wheels do not tell of the heading [rad/m]
  std::vector<double> relation_cost;  ///< squared Mahalanobis distance of each relation
};

/// Least squares over the poses of the first `poses.size()` key scans: relations from scans,
/// robust; steps of the wheels with one unknown scale and one drift of the heading, which alone
/// hold a path along a round wall; steps of dead reckoning. The first pose stays as it is.
GraphSolution solvePoseGraph(const std::vector<KeyScan>& keys,
                             const std::vector<Relation>& relations,
                             const std::vector<geometry::Pose2>& poses);

}  // namespace sightline::mapping
