#include "sightline/gaze/gaze_config.h"

namespace sightline::gaze {

void InformConfig::visit(config::FieldVisitor& visitor) {
  const config::Range time{0.01, 1e3};
  visitor.number("wall_position_sigma", wall_position_sigma,
                 {"m", {1e-4, 1.0}, "of a wall of the map"});
  visitor.number("wall_direction_sigma", wall_direction_sigma,
                 {"rad", {1e-5, 1.0}, "of a wall of the map"});
  visitor.number("least_length", least_length,
                 {"m", {0.0, 10.0}, "of wall in view, for it to count"});
  visitor.number("horizon", horizon, {"s", {0.2, 20.0}, "time ahead that a choice is judged by"});
  visitor.number("period", period, {"s", time, "between two choices"});
  visitor.number("forget", forget, {"s", time, "what hides a wall is forgotten in this time"});
}

void GazeConfig::visit(config::FieldVisitor& visitor) {
  const config::Range time{0.01, 1e3};
  visitor.choice("mode", mode, {"hold", "sweep", "fixate", "inform"},
                 "at the start; fixate: the nearest corner");
  visitor.group("head", head);
  visitor.group("field", field);
  visitor.number("rest", rest,
                 {"rad", {-geometry::kPi, geometry::kPi}, "of the head, without fresh input"});
  visitor.number("sweep_rate", sweep_rate, {"rad/s", {0.01, 100.0}, "of the mode sweep"});
  visitor.number("lead", lead, {"s", {0.0, 1.0}, "from a decision until the head has followed"});
  visitor.number("patience", patience, {"s", time, "input older than this is not fresh"});
  visitor.number("answer", answer,
                 {"s", {0.1, 0.9}, "a head that has not moved for so long is stuck"});
  visitor.number("click_radius", click_radius,
                 {"m", {0.01, 10.0}, "a feature is meant by a point so near to it"});
  visitor.number("lost_after", lost_after,
                 {"s", time, "a feature unseen for so long is searched for"});
  visitor.number("give_up", give_up, {"s", time, "time to search for a feature"});
  visitor.group("inform", inform);
  visitor.group("odometry", odometry);
}

void GazeConfig::check(const std::string& source) const {
  config::validate(*this, source);
  head.check(source);
  if (rest < head.lower || rest > head.upper) {
    throw config::Error(source, 0, "rest", "is beyond the limits of the head");
  }
  if (field.range_min >= field.range_max) {
    throw config::Error(source, 0, "field.range_min", "is not below range_max");
  }
}

}  // namespace sightline::gaze
