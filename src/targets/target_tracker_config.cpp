#include "sightline/targets/target_tracker_config.h"

#include "sightline/config/error.h"

namespace sightline::targets {

void SensorModelsConfig::visit(config::FieldVisitor& visitor) {
  common.visit(visitor);
  visitor.entries("robots", robots, "model of one robot's sensor, by the robot's name");
}

SensorModelsConfig SensorModelsConfig::readFile(const std::string& path) {
  SensorModelsConfig models;
  config::read(config::Node::readFile(path), models);
  models.common.check(path);
  for (const auto& [name, model] : models.robots) {
    try {
      model.check(path);
    } catch (const config::Error& error) {
      throw config::Error(path, 0, "robots." + name + "." + error.key(), error.reason());
    }
  }
  return models;
}

void LookSpacingConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("distance", distance,
                 {"m", {0.0, 1e6}, "that a sensor has moved since its last look counted"});
  visitor.number("turn", turn, {"rad", {0.0, geometry::kPi}, "or that it has turned"});
  visitor.number("rest", rest, {"s", {0.0, 1e6}, "or the time that has passed"});
}

void TargetTrackerConfig::visit(config::FieldVisitor& visitor) {
  visitor.choice(
      "method", method, {"bernoulli", "phd"},
      "bernoulli: Poisson multi-Bernoulli with belief propagation; phd: particles of the "
      "PHD, the filter of dames");
  visitor.group("bernoulli", bernoulli);
  visitor.group("phd", phd);
  visitor.group("spacing", spacing);
  visitor.path(
      "models", models,
      "path of the sensor models, as characterize_bearing_sensor writes them; without: the "
      "values of dames");
  visitor.path("world", world, "path of a world file whose walls hide targets");
  visitor.number("sensor_height", sensor_height,
                 {"m", {0.0, 10.0}, "height at which these walls are looked at"});
  visitor.flag("explain_mates", explain_mates,
               "bearings at which another robot stands are explained by it");
  visitor.number("mate_sigma", mate_sigma,
                 {"m", {1e-3, 10.0}, "of the place on a robot at which others see it"});
  visitor.number("max_age", max_age,
                 {"s", {0.0, 1e6}, "a look older than this behind the newest is refused"});
}

}  // namespace sightline::targets
