#pragma once

#include <map>
#include <string>

#include "sightline/targets/bernoulli_filter.h"
#include "sightline/targets/phd_filter.h"
#include "sightline/targets/sensor_model_config.h"

namespace sightline::targets {

enum class FilterMethod {
  kBernoulli,  ///< BernoulliFilter
  kPhd,        ///< PhdFilter, the paper's
};

/// Models of the sensors of a team, as characterize_bearing_sensor writes them: one for robots that
/// it knows too little of, and those of the others, by name.
///
/// ```yaml
/// bearing: {sigma: 0.0393}                  # the fields of SensorModelConfig, for all robots
/// robots:
///   robot4: {bearing: {sigma: 0.006, bias: -0.014}}   # all that is left out has its default
/// ```
struct SensorModelsConfig {
  SensorModelConfig common;
  std::map<std::string, SensorModelConfig> robots;

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error with file, line and key.
  static SensorModelsConfig readFile(const std::string& path);
};

/// Looks of one robot that tell something new: misses from one place are not independent.
struct LookSpacingConfig {
  double distance = 0.1;    ///< that the sensor has moved since the last look that counted [m]
  double turn = 0.0872665;  ///< 5°, or turned [rad]
  double rest = 5.0;        ///< or the time that has passed [s]

  void visit(config::FieldVisitor& visitor);
};

/// Settings of TargetTracker.
struct TargetTrackerConfig {
  FilterMethod method = FilterMethod::kBernoulli;
  BernoulliFilterConfig bernoulli;
  PhdFilterConfig phd;
  LookSpacingConfig spacing;
  std::string models;          ///< path of a SensorModelsConfig; empty: the paper's values
  std::string world;           ///< path of a world file whose walls hide targets; empty: none
  double sensor_height = 0.3;  ///< at which these are looked through [m]
  bool explain_mates = true;   ///< whether bearings at other robots' poses are explained by them
  double mate_sigma = 0.1;     ///< of where on a robot others see it [m]
  double max_age = 2.0;        ///< of a look behind the newest one [s]

  void visit(config::FieldVisitor& visitor);
};

}  // namespace sightline::targets
