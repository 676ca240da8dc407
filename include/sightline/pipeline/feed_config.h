#pragma once

#include <map>
#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/pipeline/body_mask.h"
#include "sightline/pipeline/odometry_bridge.h"
#include "sightline/scan/noise_model.h"

namespace sightline::pipeline {

/// Names of the frames that the estimators speak of.
struct Frames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";

  void visit(config::FieldVisitor& visitor);
  /// The frames without the leading slash that tf of old wrote.
  Frames withoutSlashes() const;
};

/// Source of the odometry of the wheels.
enum class OdometrySource {
  kAutomatic,   ///< transforms where they know odom, otherwise the topic
  kTransforms,  ///< odom to base on tf
  kTopic,       ///< nav_msgs/Odometry
  kNone,
};

/// Settings for completing scans: what is known of the scanners, and how long to wait for what
/// belongs to a scan. One set of defaults, live and over a recording.
struct FeedConfig {
  /// Noise of scans that do not bring their variances along.
  scan::NoiseModel noise{scan::NoiseKind::kEstimated};
  OdometrySource odometry_source = OdometrySource::kAutomatic;
  OdometryLimits odometry_limits;
  bool use_imu = true;
  motion::OdometryNoise sweep_noise = motion::OdometryNoise::unmeasured();
  BodySectors body;             ///< directions in which scanners see the robot itself
  double head_sigma = 0.0;      ///< of each reported angle of a turning head [rad]
  double time_offset = 0.0;     ///< added to the stamps of scans [s]
  bool correct_timing = true;   ///< learn when beams are measured (SweepTiming)
  double patience = 0.5;        ///< for what has been coming [s]
  double start_patience = 2.0;  ///< for what has not come yet [s]

  void visit(config::FieldVisitor& visitor);
};

/// Data that scans are to be completed by. Where both are left out, no scan waits for anything.
struct FeedNeeds {
  bool mounting = true;  ///< T_base_sensor
  bool odometry = true;  ///< T_odom_base and the motion within the sweep
};

}  // namespace sightline::pipeline
