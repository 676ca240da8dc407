#pragma once

#include <string>
#include <vector>

#include "sightline/targets/target_tracker_config.h"

namespace sightline::pipeline {

/// Settings of the targets, live and over a recording.
struct TargetsConfig {
  std::vector<std::string> robots;          ///< namespaces
  std::string bearings_topic = "bearings";  ///< in the namespace of each robot
  std::string pose_topic = "pose";          ///< of the sensor in the map; empty: by transforms
  std::string map_frame = "map";
  double patience = 0.5;  ///< for the pose of a look [s]
  double period = 0.0;    ///< between two outputs; 0: one a look [s]
  targets::TargetTrackerConfig tracker;

  void visit(config::FieldVisitor& visitor);
  std::string topicOf(const std::string& robot, const std::string& name) const;
};

}  // namespace sightline::pipeline
