#pragma once

#include <string>

#include "nodes/estimator_topics.h"
#include "sightline/bridge/room_output.h"

namespace sightline::nodes {

/// Parameters of the node room_tracker.
struct RoomTrackerNodeConfig {
  EstimatorTopics topics;
  pipeline::RoomsConfig rooms;
  bridge::RoomOutputConfig output{true, 0.1};
  std::string last_pose;  ///< path of the file; empty: none is kept

  void visit(config::FieldVisitor& visitor) {
    visitor.text("map_frame", topics.frames.map, "frame of the rooms");
    topics.visit(visitor);
    rooms.visit(visitor);
    output.visit(visitor);
    visitor.path("last_pose", last_pose,
                 "path of a file that keeps the pose for the next start, where initial_pose is not "
                 "set; empty: none");
  }
};

}  // namespace sightline::nodes
