#pragma once

#include <Eigen/Core>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"

namespace sightline::motion {

/// Errors of wheel odometry (jensfelt section 4.1 and appendix). Defaults are those of his robot:
/// one scale error a run, drawn about 1.006 with 1 %; heading drifts by 0.6° a metre and by 0.1 %
/// of the change of heading (in the paper: of the steering), each with a bias and a spread of that
/// size. The sideways slip is not his, and his 1 % of the length is also taken for the white part.
///
/// A step of odometry reports a length d and a turn a. What really happened is
/// - a length of s·d, with noise of variance distance_sigma²·d along the path and lateral_sigma²·d
///   across it,
/// - a turn of (1 + steering_bias)·a + heading_bias_per_metre·d, with noise of variance
///   heading_sigma_per_metre²·d + steering_sigma²·|a|.
/// The noises are random walks: each sigma is the standard deviation after the first metre or
/// radian and grows with the square root of the path, so that the result does not depend on how the
/// path is cut into steps.
struct OdometryNoise {
  double scale_mean = 1.006;     ///< true length over measured length, mean over runs
  double scale_sigma = 0.01;     ///< its standard deviation over runs
  double distance_sigma = 0.01;  ///< white part, after one metre [m]
  double lateral_sigma = 0.005;  ///< sideways slip, after one metre [m]
  double heading_bias_per_metre = 0.0104719755;   ///< 0.6° [rad/m]
  double heading_sigma_per_metre = 0.0104719755;  ///< 0.6° after one metre [rad]
  double steering_bias = 0.001;                   ///< share of the turn
  double steering_sigma = 0.001;                  ///< after one radian of turn, share of it [rad]

  void visit(config::FieldVisitor& visitor);

  /// Noise for a robot that nobody has measured. Biases are left out, since their sign is not
  /// known, and the spreads are wide enough to hold them: the scale 2 %, as jensfelt's robot with
  /// 0.6 % of bias and 1 % of spread is within one standard deviation and a tyre of another
  /// pressure within two; 2 cm and 0.02 rad (1.1°) after a metre, twice his; 1 cm sideways; 0.05
  /// rad after a radian of turn, since his synchro drive turns its wheels on the spot and a robot
  /// with two driven wheels slips in every turn.
  static OdometryNoise unmeasured();
};

/// The step as the model expects it to have happened: biases taken out, scale applied, along a path
/// of constant body velocity. Its translation is proportional to the scale.
geometry::Pose2 expectedStep(const OdometryNoise& noise, const geometry::Pose2& measured,
                             double scale);

/// Covariance of (x, y, θ), in the body frame at the start of the step, of what the model leaves
/// unknown of one step (scale apart), first order. The noise comes in evenly along a path of
/// constant body velocity, so that noise of the heading also moves the end point, and a long step
/// is as uncertain as the short ones it can be cut into (to 1 % for turns up to a radian).
Eigen::Matrix3d stepCovariance(const OdometryNoise& noise, const geometry::Pose2& step);

}  // namespace sightline::motion
