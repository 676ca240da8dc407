#pragma once

#include <string>

#include "sightline/pipeline/targets_config.h"
#include "sightline/targets/search.h"

namespace sightline::nodes {

/// Parameters of the node search; those of robots, topics and models are as of target_tracker.
struct SearchNodeConfig {
  std::vector<std::string> robots;
  std::string bearings_topic = "bearings";
  std::string pose_topic = "pose";
  std::string map_frame = "map";
  double patience = 0.5;       ///< [s]
  std::string models;          ///< path
  std::string world;           ///< path
  double sensor_height = 0.3;  ///< [m]
  bool drive = false;
  double rate = 10.0;     ///< [Hz]
  double max_gone = 3.0;  ///< [s]
  targets::SearchConfig search;

  void visit(config::FieldVisitor& visitor) {
    visitor.texts("robots", robots, "namespaces of the robots; must be set");
    visitor.text("bearings_topic", bearings_topic,
                 "topic of sightline/BearingArray in the namespace of each robot");
    visitor.text("pose_topic", pose_topic,
                 "topic of geometry_msgs/PoseWithCovarianceStamped, the sensor's pose in the map; "
                 "empty: transforms from map_frame to the frame of the bearings tell");
    visitor.text("map_frame", map_frame, "frame of the ways");
    visitor.number("patience", patience,
                   {"s", {0.0, 60.0}, "time that a look waits for the pose of its sensor"});
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

  /// Settings of the feed of looks.
  pipeline::TargetsConfig feed() const {
    pipeline::TargetsConfig config;
    config.robots = robots;
    config.bearings_topic = bearings_topic;
    config.pose_topic = pose_topic;
    config.map_frame = map_frame;
    config.patience = patience;
    return config;
  }
};

}  // namespace sightline::nodes
