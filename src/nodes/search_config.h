#pragma once

#include <string>

#include "sightline/pipeline/bearing_topics.h"
#include "sightline/targets/search.h"

namespace sightline::nodes {

/// Parameters of the node search; those of robots, topics and models are as of target_tracker.
struct SearchNodeConfig : pipeline::BearingTopics {
  std::string models;          ///< path
  std::string world;           ///< path
  double sensor_height = 0.3;  ///< [m]
  bool drive = false;
  double rate = 10.0;     ///< [Hz]
  double max_gone = 3.0;  ///< [s]
  targets::SearchConfig search;

  void visit(config::FieldVisitor& visitor) {
    BearingTopics::visit(visitor);
    visitor.path("models", models, "file of sensor models; empty: the paper's values");
    visitor.path("world", world, "world file whose walls are in the way; empty: none");
    visitor.number("sensor_height", sensor_height,
                   {"m", {0.0, 100.0}, "above the floor, at which walls are looked for"});
    visitor.flag("drive", drive, "send cmd_vel to each robot, along its way");
    visitor.number("rate", rate, {"Hz", {0.5, 100.0}, "of the commands"});
    visitor.number("max_gone", max_gone,
                   {"s", {0.1, 1e4}, "a robot without a look for so long has left the team"});
    search.visit(visitor);
  }
};

}  // namespace sightline::nodes
