#pragma once

#include <cstdint>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/simulation/body.h"
#include "sightline/simulation/bumps.h"
#include "sightline/simulation/wheel_odometry.h"

namespace sightline::simulation {

/// Velocity in the body frame of a robot that cannot drive sideways.
struct Velocity {
  double linear = 0.0;   ///< [m/s], forward
  double angular = 0.0;  ///< [rad/s], counter-clockwise
};

struct DriveLimits {
  double max_speed = 1.0;          ///< [m/s]
  double max_turn_rate = 1.5;      ///< [rad/s]
  double acceleration = 0.5;       ///< [m/s²]
  double turn_acceleration = 2.0;  ///< [rad/s²]

  void visit(config::FieldVisitor& visitor);
};

/// Follows a velocity as fast as its limits allow, exactly where it is told to.
class Drive {
 public:
  Drive(const DriveLimits& limits, const geometry::Pose2& T_map_base)
      : limits_(limits), T_map_base_(T_map_base) {}

  /// Moves for `duration` [s], small against the time that the velocity takes to change, and
  /// returns the motion in the body frame before it.
  geometry::Pose2 step(const Velocity& wanted, double duration);

  const geometry::Pose2& T_map_base() const { return T_map_base_; }
  const Velocity& velocity() const { return velocity_; }

 private:
  DriveLimits limits_;
  geometry::Pose2 T_map_base_;
  Velocity velocity_;
};

struct RobotConfig : DriveLimits {
  double command_timeout = 0.5;  ///< [s]
  motion::OdometryNoise odometry;
  Body body;         ///< what other robots see of it
  BumpConfig bumps;  ///< of the floor that it drives on

  void visit(config::FieldVisitor& visitor);
};

/// A robot on two wheels, which report with errors how it drives.
class Robot {
 public:
  Robot(const RobotConfig& config, const geometry::Pose2& T_map_base, std::uint64_t seed);

  /// Moves for `duration` [s], small against the time that the velocity takes to change.
  void step(const Velocity& wanted, double duration);

  const geometry::Pose2& T_map_base() const { return drive_.T_map_base(); }
  const Velocity& velocity() const { return drive_.velocity(); }
  const WheelOdometry& odometry() const { return odometry_; }
  WheelOdometry& odometry() { return odometry_; }

 private:
  Drive drive_;
  WheelOdometry odometry_;
};

}  // namespace sightline::simulation
