#pragma once

#include <Eigen/Geometry>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"

namespace sightline::simulation {

/// Pose of a sensor on its robot; angles as roll, pitch and yaw about the robot's fixed axes, so
/// that a roll of π mounts it upside down.
struct Mounting {
  double x = 0.0;      ///< [m], forward
  double y = 0.0;      ///< [m], left
  double z = 0.0;      ///< [m] above the floor
  double roll = 0.0;   ///< [rad]
  double pitch = 0.0;  ///< [rad], positive looks down
  double yaw = 0.0;    ///< [rad]

  void visit(config::FieldVisitor& visitor);
  Eigen::Isometry3d T_base_sensor() const;
};

}  // namespace sightline::simulation
