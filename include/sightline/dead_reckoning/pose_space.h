#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/matcher.h"
#include "sightline/dead_reckoning/search_window.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/fitting/rigid_alignment.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Points sorted by x, so that a neighbour is sought among those whose x is near.
class SortedPoints {
 public:
  SortedPoints() = default;
  explicit SortedPoints(const std::vector<SurfacePoint>& points);

  /// The nearest neighbour (saarinen eq. 4.6), null where it is further than `reach` [m].
  const Eigen::Vector2d* nearest(const Eigen::Vector2d& point, double reach) const;
  /// Tells whether there is any point within reach: eq. 4.5 needs no more.
  bool hasNear(const Eigen::Vector2d& point, double reach) const;

 private:
  std::vector<Eigen::Vector2d> points_;
};

/// A pose of a scan in the frame of the reference, and how many of its points match there.
struct Correlation {
  geometry::Pose2 T_reference_base;
  std::size_t count = 0;
  std::size_t evaluations = 0;  ///< poses that were tried
};

/// Correlation in pose space (saarinen alg. 4): every pose of an even distribution is tried; first
/// coarse in position, then finer about the best. Headings keep their step, as a coarse one moves
/// distant points too far. A window that holds more poses than can be tried is searched with steps
/// as much coarser as it takes, in position first.
Correlation correlatePoses(const std::vector<SurfacePoint>& points, const SortedPoints& reference,
                           const SearchWindow& window, const PoseSpaceConfig& config);

/// Saarinen section 4.3.4.1: the reference scan is held while enough points match it, and the best
/// pose is corrected by the least squares of the matching pairs (algorithm 3).
class PoseSpaceMatcher : public Matcher {
 public:
  explicit PoseSpaceMatcher(const PoseSpaceConfig& config) : config_(config) {}

  bool hasReference() const override { return T_odom_reference_.has_value(); }
  MatchOutcome match(const SurfaceScan& surfaces, const geometry::UncertainPose2& prior,
                     const SearchWindow& window) const override;
  double learn(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base,
               const MatchOutcome& outcome) override;
  void clear() override { T_odom_reference_.reset(); }

 private:
  std::vector<fitting::PointPair> pairsAt(const SurfaceScan& surfaces,
                                          const geometry::Pose2& T_reference_base) const;

  PoseSpaceConfig config_;
  std::optional<geometry::Pose2> T_odom_reference_;
  SortedPoints reference_;
};

}  // namespace sightline::dead_reckoning
