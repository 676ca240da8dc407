#pragma once

#include <Eigen/Core>

#include "sightline/dead_reckoning/matcher.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// Covariance that the noise of the motion within a sweep makes of a pose merged of prediction and
/// match.
Eigen::Matrix3d motionCovariance(const geometry::UncertainPose2& predicted,
                                 const MatchOutcome& outcome);

/// Shares of translation, along the axis that was measured least, and of heading that a merged pose
/// knows by the match and not by the prediction, [0, 1].
Eigen::Vector2d measuredShares(const geometry::UncertainPose2& predicted,
                               const MatchOutcome& outcome);

}  // namespace sightline::dead_reckoning
