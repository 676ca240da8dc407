#pragma once

#include "sightline/config/fields.h"
#include "sightline/motion/odometry_noise.h"

namespace sightline::lines {

/// Settings of features over scans. How far a thing may be from where it is looked for follows from
/// the covariances of the lines and the noise of the odometry.
struct FeatureTrackerConfig {
  motion::OdometryNoise odometry = motion::OdometryNoise::unmeasured();
  double gate = 3.7;          ///< for a sighting to be of a feature [σ]
  double speed_sigma = 0.7;   ///< of things that move [m/s]
  double acceleration = 0.5;  ///< of things that move, white, in a second [m/s²]
  double start_rate = 0.02;   ///< things at rest that set off [1/s]
  double stop_rate = 0.2;     ///< moving things that stop [1/s]
  double decided = 0.95;      ///< probability from which a behaviour is stated
  double absence = 2.0;       ///< a feature in view is dropped after so long without a sighting [s]
  double forgotten_sigma = 0.5;  ///< a feature out of view is dropped when so uncertain [m]
  double wall_memory = 5.0;      ///< a wall out of view keeps its id for so long [s]
  int max_features = 128;
  int max_walls = 128;

  void visit(config::FieldVisitor& visitor);
};

}  // namespace sightline::lines
