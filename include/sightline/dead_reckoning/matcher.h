#pragma once

#include <cstddef>
#include <memory>

#include <Eigen/Core>

#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/match_state.h"
#include "sightline/dead_reckoning/search_window.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Results of a match that the matcher needs again when it learns the scan.
struct ReferenceTrace {
  bool is_held = false;   ///< the reference scan explains the scan well enough to be kept
  bool is_fresh = false;  ///< the second reference explains the scan, the first does not
};

/// Result of matching one scan.
struct MatchOutcome {
  geometry::Pose2 T_odom_base;  ///< the most probable, the prior included
  /// Information of the scan alone on the coordinates (x, y, θ); may be singular.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Share of the variance of its errors that comes from the reference, and so is the same from one
  /// scan to the next.
  double common = 0.0;
  /// Covariance of what several candidates leave open, on top of all else.
  Eigen::Matrix3d extra_covariance = Eigen::Matrix3d::Zero();
  /// Covariance of what the noise of the sensor's motion adds to the gradient of the least squares
  /// that `information` belongs to (MotionGradient).
  Eigen::Matrix3d motion_gradient = Eigen::Matrix3d::Zero();
  MatchState state = MatchState::kFailed;
  double inliers = 0.0;         ///< share of the points, [0, 1]
  double known = 1.0;           ///< share of the points where the reference says what there is
  double cost = 1.0;            ///< share of the scan that is left unexplained, [0, 1] and beyond
  std::size_t evaluations = 0;  ///< poses that were compared; bounded whatever the settings
  ReferenceTrace reference;
};

/// A way to compare a scan with a reference of its own. Poses are T_odom_base; covariances are of
/// their coordinates.
class Matcher {
 public:
  virtual ~Matcher() = default;
  virtual bool hasReference() const = 0;
  /// Needs a reference.
  /// @param prior  what is known of the pose besides the scan
  virtual MatchOutcome match(const SurfaceScan& surfaces, const geometry::UncertainPose2& prior,
                             const SearchWindow& window) const = 0;
  /// Takes the scan into the reference, at its pose, where it is time to. Returns the share of the
  /// reference in view that is new, [0, 1].
  /// @param outcome  of the match of this scan; a default one where there was no reference
  virtual double learn(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base,
                       const MatchOutcome& outcome) = 0;
  virtual void clear() = 0;
};

/// The matcher of the configured method. Throws config::Error if the configuration is out of range.
std::unique_ptr<Matcher> makeMatcher(const DeadReckonerConfig& config);

}  // namespace sightline::dead_reckoning
