#pragma once

#include <Eigen/Core>

namespace sightline::dead_reckoning {

/// A prior covariance of the coordinates (x, y, θ), turned a trifle so that its longest axis is the
/// one along which a match knows nothing.
///
/// Along a bare corridor a prior grows to metres, aligned with the walls as the matches before
/// showed them; the next match shows their direction a few thousandths of a radian off. Taken at
/// its word, each centimetre that is found across would move the pose by decimetres along. Where
/// the match binds the axis, or the two directions differ by more than they err, the covariance is
/// returned as it is.
///
/// @param information  of the match, on the same coordinates
Eigen::Matrix3d turnedToUnbound(const Eigen::Matrix3d& covariance,
                                const Eigen::Matrix3d& information);

/// Tells whether a step with this covariance may well be off by 20 cm or 5 degrees.
bool isLoose(const Eigen::Matrix3d& covariance);

}  // namespace sightline::dead_reckoning
