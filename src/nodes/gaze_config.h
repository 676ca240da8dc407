#pragma once

#include <string>

#include "sightline/gaze/gaze_config.h"
#include "sightline/pipeline/feed_config.h"

namespace sightline::nodes {

/// Parameters of the node gaze.
struct GazeNodeConfig {
  std::string map;
  std::string range_scan = "range_scan";
  std::string mount_frame = "active_sensor";
  std::string joint = "head_joint";
  double rate = 50.0;  ///< [Hz]
  pipeline::Frames frames;
  gaze::GazeConfig gaze;

  void visit(config::FieldVisitor& visitor) {
    visitor.path("map", map, "path of the rooms file, for the mode inform; may be empty");
    visitor.text("range_scan", range_scan,
                 "topic of the sensor on the head: its field, and what hides the walls of the map; "
                 "without such scans, or with an empty name, the field is that of the parameters");
    visitor.text("map_frame", frames.map, "frame of pose");
    visitor.text("odom_frame", frames.odom, "frame of features");
    visitor.text("base_frame", frames.base, "frame of the robot");
    visitor.text("mount_frame", mount_frame, "frame in which the head turns about the z axis");
    visitor.text("joint", joint, "of the head, in joint_states and head_command");
    visitor.number("rate", rate, {"Hz", {1.0, 200.0}, "of decisions"});
    gaze.visit(visitor);
  }
};

}  // namespace sightline::nodes
