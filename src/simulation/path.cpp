#include "sightline/simulation/path.h"

#include <algorithm>
#include <cmath>

namespace sightline::simulation {

Path::Path(const config::Node& document) {
  document.allowOnly({"wait", "speed", "turn_rate", "tolerance", "repeat", "waypoints"});
  config::read(document, *this, config::UnknownKeys::kIgnore);
  for (const config::Node& node : document.at("waypoints").items()) {
    const auto xy = node.numbers(2, {-1e6, 1e6});
    waypoints_map.emplace_back(xy[0], xy[1]);
  }
}

void Path::visit(config::FieldVisitor& visitor) {
  visitor.number("wait", wait, {"s", {0.0, 1e6}, "before the robot sets off"});
  visitor.number("speed", speed, {"m/s", {1e-3, 50.0}, "of the robot along the path"});
  visitor.number("turn_rate", turn_rate, {"rad/s", {1e-3, 50.0}, "the robot turns no faster"});
  visitor.number("tolerance", tolerance,
                 {"m", {1e-3, 100.0}, "this near to a waypoint the next one is headed for"});
  visitor.flag("repeat", repeat, "from the last waypoint on to the first, for ever");
}

PathFollower::PathFollower(Path path, double acceleration)
    : path_(std::move(path)), acceleration_(acceleration) {}

bool PathFollower::isPassed(const Eigen::Vector2d& target_base) const {
  constexpr double kArrived = 0.02;  // m from the last waypoint, which is worth coming close to
  const double distance = target_base.norm();
  if (!isLast()) return distance < path_.tolerance;
  return distance < kArrived || (distance < path_.tolerance && target_base.x() < 0.0);
}

Velocity PathFollower::towards(const Eigen::Vector2d& target_base) const {
  constexpr double kTurnGain = 2.0;  // 1/s
  const double bearing = std::atan2(target_base.y(), target_base.x());
  const double braking = std::sqrt(2.0 * acceleration_ * target_base.norm());
  const double speed = isLast() ? std::min(path_.speed, braking) : path_.speed;
  // Full speed straight ahead, none from 60° on.
  const double share = std::max(0.0, 2.0 * std::cos(bearing) - 1.0);
  return {speed * share, std::clamp(kTurnGain * bearing, -path_.turn_rate, path_.turn_rate)};
}

Velocity PathFollower::steer(const geometry::Pose2& T_map_base) {
  const geometry::Pose2 T_base_map = T_map_base.inverse();
  for (std::size_t tried = 0; !hasArrived() && tried < path_.waypoints_map.size(); ++tried) {
    const Eigen::Vector2d target_base = T_base_map * path_.waypoints_map[next_];
    if (!isPassed(target_base)) return towards(target_base);
    ++next_;
    if (path_.repeat) next_ %= path_.waypoints_map.size();
  }
  return {};
}

}  // namespace sightline::simulation
