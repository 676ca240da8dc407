#include "sightline/simulation/robot.h"

#include <algorithm>

namespace sightline::simulation {

namespace {

// As near to the wanted value as a bounded value with a bounded change comes.
double approach(double value, double wanted, double limit, double change) {
  return value + std::clamp(std::clamp(wanted, -limit, limit) - value, -change, change);
}

}  // namespace

void RobotConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("max_speed", max_speed, {"m/s", {1e-3, 50.0}, "fastest drive"});
  visitor.number("max_turn_rate", max_turn_rate, {"rad/s", {1e-3, 50.0}, "fastest turn"});
  visitor.number("acceleration", acceleration,
                 {"m/s^2", {1e-3, 1e6}, "how fast the speed changes"});
  visitor.number("turn_acceleration", turn_acceleration,
                 {"rad/s^2", {1e-3, 1e6}, "how fast the turn rate changes"});
  visitor.number("command_timeout", command_timeout,
                 {"s", {1e-3, 1e6}, "the robot stops when no command came for this long"});
  visitor.group("odometry", odometry);
}

Robot::Robot(const RobotConfig& config, const geometry::Pose2& T_map_base, std::uint64_t seed)
    : config_(config), T_map_base_(T_map_base), odometry_(config.odometry, seed) {}

void Robot::step(const Velocity& wanted, double duration) {
  velocity_.linear =
      approach(velocity_.linear, wanted.linear, config_.max_speed, config_.acceleration * duration);
  velocity_.angular = approach(velocity_.angular, wanted.angular, config_.max_turn_rate,
                               config_.turn_acceleration * duration);
  const geometry::Pose2 moved =
      geometry::Pose2::exp({velocity_.linear * duration, 0.0, velocity_.angular * duration});
  T_map_base_ = T_map_base_ * moved;
  odometry_.advance(moved);
}

}  // namespace sightline::simulation
