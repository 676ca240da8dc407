#pragma once

#include "sightline/config/fields.h"
#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"

namespace sightline::pipeline {

/// Noise of wheels that nobody has measured. The two sigmas come on top, once a step between
/// scans: what wheels report of a moment is late or rounded.
struct WheelsConfig {
  motion::OdometryNoise noise = unmeasured();
  double position_sigma = 0.02;  ///< [m]
  double heading_sigma = 0.01;   ///< [rad]

  void visit(config::FieldVisitor& visitor);
  static motion::OdometryNoise unmeasured();
};

/// The step of the wheels between two scans as a prior.
dead_reckoning::MotionPrior wheelPrior(const WheelsConfig& config,
                                       const geometry::Pose2& T_before_now);

}  // namespace sightline::pipeline
