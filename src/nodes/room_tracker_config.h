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

  void visit(config::FieldVisitor& visitor) {
    visitor.text("map_frame", topics.frames.map, "frame of the rooms");
    topics.visit(visitor);
    rooms.visit(visitor);
    output.visit(visitor);
  }
};

}  // namespace sightline::nodes
