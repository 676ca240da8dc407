#pragma once

#include "sightline/dead_reckoning/line_matcher.h"
#include "sightline/dead_reckoning/range_profile.h"
#include "sightline/dead_reckoning/submap.h"
#include "sightline/dead_reckoning/surface_points.h"

namespace sightline::dead_reckoning {

/// Evidence for and against a pose, as ratios of the scan's points, [0, 1].
struct Evidence {
  double inliers = 0.0;         ///< lie on their counterpart in the reference
  double contradictions = 0.0;  ///< lie where the reference saw free space, or look through it
  double cost = 1.0;            ///< 0: all explained; 1: nothing is
  double known = 0.0;           ///< lie where the reference says what there is
  double known_cost = 1.0;      ///< cost of those alone
};

/// Weighs a match. A point without a counterpart is no witness against it where the reference did
/// not see; where it saw free space it is one, and so is a point of the scanner's newest keyframe
/// that the scan looks through.
///
/// @param profile  of the same sweep
Evidence weigh(const LineMatch& match, const SurfaceScan& surfaces, const RangeProfile& profile,
               const Submap& submap);

/// Statistics of the residuals of a match that its covariance depends on.
struct ResidualStatistics {
  double variance = 1.0;     ///< in units of what was expected
  double correlation = 0.0;  ///< of neighbours, [0, 1): they share errors of the reference

  /// Factor by which the covariance of the match is larger than its information says: n neighbours
  /// count as n (1 − r)/(1 + r) at a correlation r.
  double factor() const { return variance * (1.0 + correlation) / (1.0 - correlation); }
  /// The share of that which is due to the reference.
  double common() const { return 2.0 * correlation / (1.0 + correlation); }
};

ResidualStatistics residualStatistics(const LineMatch& match);

}  // namespace sightline::dead_reckoning
