#pragma once

#include <memory>

#include "sightline/dead_reckoning/correlative_search.h"
#include "sightline/dead_reckoning/match_state.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// What a matcher found of one scan.
struct MatchOutcome {
  geometry::Pose2 T_odom_base;  ///< the most probable, the prior included
  /// What the scan alone says of its coordinates (x, y, θ); may be singular.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Share of the variance of its errors that comes from the reference, and so is the same from one
  /// scan to the next.
  double common = 0.0;
  /// Covariance of what several candidates leave open, on top of all else.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  MatchState state = MatchState::kFailed;
  double inliers = 0.0;  ///< share of the points, [0, 1]
  bool searched = false;
};

/// A way to compare a scan with a reference of its own. Poses are T_odom_base; covariances are of
/// their coordinates.
class Matcher {
 public:
  virtual ~Matcher() = default;
  virtual std::unique_ptr<Matcher> clone() const = 0;
  virtual bool hasReference() const = 0;
  /// Needs a reference.
  /// @param prior  what is known of the pose besides the scan
  virtual MatchOutcome match(const Sweep& sweep, const geometry::UncertainPose2& prior,
                             const SearchWindow& window) = 0;
  /// Takes the scan last matched, at its pose, into the reference, where it is time to. Returns
  /// the share of the reference in view that is new, [0, 1].
  virtual double learn(const Sweep& sweep, const geometry::Pose2& T_odom_base,
                       MatchState state) = 0;
  virtual void clear() = 0;
};

}  // namespace sightline::dead_reckoning
