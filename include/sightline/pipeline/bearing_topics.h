#pragma once

#include <string>
#include <vector>

#include "sightline/config/field_visitor.h"

namespace sightline::pipeline {

/// Robots of a team, and where their bearings and poses are told, live and in recordings.
struct BearingTopics {
  std::vector<std::string> robots;          ///< namespaces
  std::string bearings_topic = "bearings";  ///< in the namespace of each robot
  std::string pose_topic = "pose";          ///< of the sensor in the map; empty: by transforms
  std::string map_frame = "map";
  double patience = 0.5;  ///< for the pose of a look [s]

  void visit(config::FieldVisitor& visitor);
  /// A name in the namespace of a robot.
  std::string topicOf(const std::string& robot, const std::string& name) const;
};

}  // namespace sightline::pipeline
