#include "sightline/dead_reckoning/match_gain.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace sightline::dead_reckoning {

using geometry::UncertainPose2;

Eigen::Matrix3d motionCovariance(const UncertainPose2& predicted, const MatchOutcome& outcome) {
  if (outcome.motion_gradient.isZero(0.0)) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d merged = (predicted.covariance.inverse() + outcome.information).inverse();
  return merged * outcome.motion_gradient * merged.transpose();
}

Eigen::Vector2d measuredShares(const UncertainPose2& predicted, const MatchOutcome& outcome) {
  const Eigen::Matrix3d& prior = predicted.covariance;
  const Eigen::Matrix3d merged = (prior.inverse() + outcome.information).inverse();
  const Eigen::Matrix2d left =
      prior.topLeftCorner<2, 2>().llt().solve(merged.topLeftCorner<2, 2>());
  // Largest eigenvalue of what is left of the variance; all are real and within [0, 1].
  const double half = 0.5 * left.trace();
  const double most = half + std::sqrt(std::max(0.0, half * half - left.determinant()));
  return (Eigen::Vector2d::Ones() - Eigen::Vector2d(most, merged(2, 2) / prior(2, 2)))
      .cwiseMax(0.0);
}

}  // namespace sightline::dead_reckoning
