#pragma once

#include <string>

#include "sightline/config/fields.h"
#include "sightline/gaze/sensor_field.h"
#include "sightline/geometry/angle.h"
#include "sightline/motion/head_command.h"
#include "sightline/motion/odometry_noise.h"

namespace sightline::gaze {

enum class GazeMode {
  kHold,    ///< stay
  kSweep,   ///< turn from limit to limit
  kFixate,  ///< keep a feature in the field
  kInform,  ///< look where the pose becomes the most certain
};

/// Settings of the choice of where to look for certainty.
struct InformConfig {
  double wall_position_sigma = 0.01;    ///< of a wall of the map [m]
  double wall_direction_sigma = 0.004;  ///< [rad]
  double least_length = 0.25;           ///< of wall in view, for it to count [m]
  double horizon = 3.0;                 ///< time ahead that a choice is judged by [s]
  double period = 0.2;                  ///< between two choices [s]
  double forget = 20.0;                 ///< what hides a wall is forgotten in this time [s]

  void visit(config::FieldVisitor& visitor);
};

/// Settings of the gaze.
struct GazeConfig {
  GazeMode mode = GazeMode::kHold;
  motion::HeadLimits head;
  SensorField field;
  double rest = 0.0;          ///< of the head, without fresh input [rad]
  double sweep_rate = 0.8;    ///< [rad/s]
  double lead = 0.06;         ///< from a decision until the head has followed [s]
  double patience = 0.5;      ///< input older than this is not fresh [s]
  double answer = 0.6;        ///< a head that has not moved for so long is stuck [s]
  double click_radius = 0.3;  ///< a feature is meant by a point so near to it [m]
  double lost_after = 0.3;    ///< a feature unseen for so long is searched for [s]
  double give_up = 20.0;      ///< time to search for a feature [s]
  InformConfig inform;
  motion::OdometryNoise odometry = motion::OdometryNoise::unmeasured();

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where a value is out of range or two do not fit.
  void check(const std::string& source) const;
};

}  // namespace sightline::gaze
