#pragma once

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/scan/motion_noise.h"

namespace sightline::motion {

/// ∂ coordinates of `exp(ξ) · motion` / ∂ξ at ξ = 0: how a twist of the frame that a motion starts
/// from, ordered x, y, θ, changes the motion's coordinates. Its inverse takes errors of coordinates
/// to that frame's twists, where a change of frame is the adjoint.
Eigen::Matrix3d coordinatesByStartTwist(const geometry::Pose2& motion);

/// Noise of odometry in a sensor's motion during a sweep in which its carrier moved, and the sensor
/// stood still on it. The errors of odometry are random walks, of which each stretch of constant
/// velocity (kStretch) is one step: in a sweep of n stretches 1/n of the covariance is a drift, and
/// the rest a walk, which gives the mean variance within the sweep that such steps have. The error
/// of the scale is left out: an estimator of poses has it as a state.
///
/// @param noise             of the carrier's odometry
/// @param T_start_end_base  carrier's motion from the first beam to the last, as reported
/// @param T_base_sensor     mounting of the sensor at the first beam
/// @param duration          time from the first beam to the last [s]
scan::MotionNoise sweepNoise(const OdometryNoise& noise, const geometry::Pose2& T_start_end_base,
                             const geometry::Pose2& T_base_sensor, double duration);

}  // namespace sightline::motion
