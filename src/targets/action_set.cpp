#include "sightline/targets/action_set.h"

#include <algorithm>
#include <cmath>

#include "sightline/config/error.h"

namespace sightline::targets {

namespace {

// A way that is shorter leads nowhere [m].
constexpr double kShortestWay = 0.3;

}  // namespace

void ActionSetConfig::visit(config::FieldVisitor& visitor) {
  visitor.integer("headings", headings,
                  {"-", {1, 360}, "directions of the ways, the first along the map's x axis"});
  visitor.numbers("lengths", lengths, {"m", {0.1, 1e4}, "of the ways (dames figure 3)"});
  visitor.integer("looks", looks,
                  {"-", {1, 100}, "poses along a way by which it is judged, T (dames figure 3)"});
  visitor.number("clearance", clearance,
                 {"m", {0.0, 10.0}, "kept from walls ahead, half of it beside a way"});
  visitor.number("speed", speed, {"m/s", {1e-3, 50.0}, "of the robots"});
  visitor.number("turn_rate", turn_rate, {"rad/s", {1e-3, 50.0}, "at which they turn to a way"});
  visitor.numbers("area", area,
                  {"m", config::kCoordinate,
                   "x_min, y_min, x_max, y_max that no way leaves; without: anywhere"});
}

void ActionSetConfig::check(const std::string& source) const {
  config::validate(*this, source);
  if (lengths.empty()) throw config::Error(source, 0, "lengths", "none are given");
  if (area.empty()) return;
  if (area.size() == 4 && area[0] < area[2] && area[1] < area[3]) return;
  throw config::Error(source, 0, "area", "expected x_min, y_min, x_max, y_max");
}

ActionSet::ActionSet(const ActionSetConfig& config, std::shared_ptr<const LineOfSight> sight)
    : config_(config), sight_(std::move(sight)) {
  config_.check();
}

// Free are the middle and both sides of the way.
bool ActionSet::isFree(const Eigen::Vector2d& from_map, const Eigen::Vector2d& to_map,
                       double clearance) const {
  const auto& area = config_.area;
  if (!area.empty() && (to_map.x() < area[0] || to_map.y() < area[1] || to_map.x() > area[2] ||
                        to_map.y() > area[3])) {
    return false;
  }
  if (!sight_) return true;
  const Eigen::Vector2d along = (to_map - from_map).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  for (const double side : {0.0, -0.5 * clearance, 0.5 * clearance}) {
    if (!sight_->isClear(from_map + side * across, to_map + side * across)) return false;
  }
  return true;
}

// The longest free way ahead, up to a length, by halving [m].
double ActionSet::reach(const geometry::Pose2& T_map_start, double length, double clearance) const {
  const auto is_free = [&](double way) {
    return isFree(T_map_start.translation(), T_map_start * Eigen::Vector2d(way + clearance, 0.0),
                  clearance);
  };
  if (is_free(length)) return length;
  double free = 0.0;
  double blocked = length;
  while (blocked - free > 0.05) {
    const double middle = 0.5 * (free + blocked);
    (is_free(middle) ? free : blocked) = middle;
  }
  return free;
}

SearchAction ActionSet::actionTo(const geometry::Pose2& T_map_sensor, double heading,
                                 double length) const {
  const geometry::Pose2 T_map_start(T_map_sensor.translation(), heading);
  SearchAction action;
  for (int i = 1; i <= config_.looks; ++i) {
    const Eigen::Vector2d place = T_map_start * Eigen::Vector2d(length * i / config_.looks, 0.0);
    action.poses.emplace_back(place, heading);
  }
  const double turn = std::abs(geometry::wrapAngle(heading - T_map_sensor.theta()));
  action.duration = turn / config_.turn_rate + length / config_.speed;
  return action;
}

std::vector<SearchAction> ActionSet::from(const geometry::Pose2& T_map_sensor) const {
  // More than a line of sight forgives at its end, so that no way leads through a wall.
  for (const double share : {1.0, 0.5, 0.3}) {
    const auto actions = within(T_map_sensor, share * config_.clearance);
    if (!actions.empty()) return actions;
  }
  return {};
}

std::vector<SearchAction> ActionSet::within(const geometry::Pose2& T_map_sensor,
                                            double clearance) const {
  std::vector<SearchAction> actions;
  for (int i = 0; i < config_.headings; ++i) {
    const double heading = geometry::wrapAngle(2.0 * geometry::kPi * i / config_.headings);
    double longest = 0.0;
    for (const double wanted : config_.lengths) {
      const double length = reach({T_map_sensor.translation(), heading}, wanted, clearance);
      if (length < kShortestWay || length < longest + kShortestWay) continue;
      longest = length;
      actions.push_back(actionTo(T_map_sensor, heading, length));
    }
  }
  return actions;
}

}  // namespace sightline::targets
