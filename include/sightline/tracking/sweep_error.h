#pragma once

#include <Eigen/Core>

namespace sightline::tracking {

/// Knots of the error of a sweep's motion, at even times after the first beam, the last of them at
/// the last beam. Two let the walls of the first half err otherwise than those of the second.
constexpr int kKnots = 2;

/// Twists of the base frame, ordered x, y, θ [m, rad], by which the reported motion is off at each
/// knot, one below the other. Between two knots the error goes straight but for what a walk strays.
using SweepError = Eigen::Matrix<double, 3 * kKnots, 1>;
using SweepErrorCovariance = Eigen::Matrix<double, 3 * kKnots, 3 * kKnots>;
/// ∂(ρ, φ) / ∂ SweepError.
using LineBySweepError = Eigen::Matrix<double, 2, 3 * kKnots>;

/// Covariance of the base frame's twist at the last beam, by what makes it.
struct SweepNoise {
  /// A velocity that is wrong by the same amount throughout.
  Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();
  /// A random walk.
  Eigen::Matrix3d walk = Eigen::Matrix3d::Zero();

  Eigen::Matrix3d atEnd() const { return drift + walk; }
  /// Covariance at all knots: s s' drift + min(s, s') walk at the ratios s, s' of the sweep's time.
  SweepErrorCovariance atKnots() const;
};

}  // namespace sightline::tracking
