#include "sightline/lines/feature_tracker_config.h"

namespace sightline::lines {

void FeatureTrackerConfig::visit(config::FieldVisitor& visitor) {
  const config::Range probability{0.5, 1.0};
  const config::Range rate{0.0, 10.0};
  visitor.group("odometry", odometry);
  visitor.number("gate", gate,
                 {"sigma", {1.0, 10.0}, "largest distance of a sighting from its feature"});
  visitor.number("speed_sigma", speed_sigma, {"m/s", {0.01, 10.0}, "of things that move"});
  visitor.number("acceleration", acceleration,
                 {"m/s^2", {0.0, 10.0}, "of things that move: change of velocity in a second"});
  visitor.number("start_rate", start_rate, {"1/s", rate, "things at rest that set off"});
  visitor.number("stop_rate", stop_rate, {"1/s", rate, "moving things that stop"});
  visitor.number("decided", decided,
                 {"1", probability, "probability from which the behaviour is stated"});
  visitor.number("absence", absence,
                 {"s", {0.0, 1e3}, "a feature in view is dropped when missed for so long"});
  visitor.number("forgotten_sigma", forgotten_sigma,
                 {"m", {0.01, 10.0}, "a feature out of view is dropped when so uncertain"});
  visitor.number("wall_memory", wall_memory,
                 {"s", {0.0, 1e3}, "a wall out of view keeps its id for so long"});
  visitor.integer("max_features", max_features,
                  {"1", {1, 10000}, "kept at once; the longest unseen and least certain go first"});
  visitor.integer("max_walls", max_walls,
                  {"1", {1, 10000}, "kept at once; the same goes for them"});
}

}  // namespace sightline::lines
