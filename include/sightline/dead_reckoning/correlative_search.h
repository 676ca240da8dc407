#pragma once

#include <cstddef>
#include <vector>

#include "sightline/dead_reckoning/search_rasters.h"
#include "sightline/dead_reckoning/search_window.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

struct SearchCandidate {
  geometry::Pose2 T_odom_base;
  /// Share of the points that lie on the reference, less what its distance from the prior costs
  /// (surpriseCost), up to 1.
  double score = 0.0;
};

struct SearchResult {
  std::vector<SearchCandidate> candidates;  ///< best first
  std::size_t evaluations = 0;              ///< poses that were scored
};

/// Looks for a scan everywhere in a window: saarinen alg. 4, with the distance to the nearest
/// neighbour looked up in rasters of the reference, by branch and bound (Hess et al. 2016): blocks
/// of positions are divided in the order of what they may count at most. Finds the best poses of
/// the window that are not neighbours of a better one. The number of poses that are scored is
/// bounded, however wide the window is.
///
/// @param rasters  drawn about the window's centre
/// @param sigma    standard deviations of the prior's coordinates, about the window's centre
///                 [m, m, rad]
/// @param most     candidates
SearchResult searchRasters(const std::vector<SurfacePoint>& points, const SearchRasters& rasters,
                           const SearchWindow& window, const Eigen::Vector3d& sigma,
                           std::size_t most);

}  // namespace sightline::dead_reckoning
