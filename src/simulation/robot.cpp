#include "sightline/simulation/robot.h"

#include <algorithm>

namespace sightline::simulation {

namespace {

// Moves a value towards the wanted one, no further than `change`, within ±`limit`.
double approach(double value, double wanted, double limit, double change) {
  return value + std::clamp(std::clamp(wanted, -limit, limit) - value, -change, change);
}

}  // namespace

void DriveLimits::visit(config::FieldVisitor& visitor) {
  visitor.number("max_speed", max_speed, {"m/s", {1e-3, 50.0}, "fastest drive"});
  visitor.number("max_turn_rate", max_turn_rate, {"rad/s", {1e-3, 50.0}, "fastest turn"});
  visitor.number("acceleration", acceleration,
                 {"m/s^2", {1e-3, 1e6}, "how fast the speed changes"});
  visitor.number("turn_acceleration", turn_acceleration,
                 {"rad/s^2", {1e-3, 1e6}, "how fast the turn rate changes"});
}

void RobotConfig::visit(config::FieldVisitor& visitor) {
  DriveLimits::visit(visitor);
  visitor.number("command_timeout", command_timeout,
                 {"s", {1e-3, 1e6}, "the robot stops when no command came for this long"});
  visitor.group("odometry", odometry);
  visitor.group("body", body);
  visitor.group("bumps", bumps);
}

geometry::Pose2 Drive::step(const Velocity& wanted, double duration) {
  velocity_.linear =
      approach(velocity_.linear, wanted.linear, limits_.max_speed, limits_.acceleration * duration);
  velocity_.angular = approach(velocity_.angular, wanted.angular, limits_.max_turn_rate,
                               limits_.turn_acceleration * duration);
  const geometry::Pose2 moved =
      geometry::Pose2::exp({velocity_.linear * duration, 0.0, velocity_.angular * duration});
  T_map_base_ = T_map_base_ * moved;
  return moved;
}

Robot::Robot(const RobotConfig& config, const geometry::Pose2& T_map_base, std::uint64_t seed)
    : drive_(config, T_map_base), odometry_(config.odometry, seed) {}

void Robot::step(const Velocity& wanted, double duration) {
  odometry_.advance(drive_.step(wanted, duration));
}

}  // namespace sightline::simulation
