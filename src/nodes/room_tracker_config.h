#pragma once

#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/scan/noise_model.h"
#include "sightline/tracking/tracker_config.h"

namespace sightline::nodes {

/// Parameters of the node room_tracker.
struct RoomTrackerNodeConfig {
  std::string rooms;           ///< path of the rooms file
  std::string scans = "scan";  ///< topics, apart by spaces
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  bool publish_tf = true;
  double transform_tolerance = 0.1;             ///< [s]
  double odometry_timeout = 0.5;                ///< [s]
  double map_resolution = 0.05;                 ///< [m]
  std::vector<double> initial_pose;             ///< x, y, yaw [m, m, rad], or none
  std::vector<double> initial_sigma{0.3, 0.1};  ///< position, heading [m, rad]
  scan::NoiseModel noise;
  tracking::TrackerConfig tracker;

  void visit(config::FieldVisitor& visitor) {
    visitor.text("rooms", rooms, "path of the rooms file; must be set");
    visitor.text("scans", scans, "topics of the scanners, apart by spaces");
    visitor.text("map_frame", map_frame, "frame of the rooms");
    visitor.text("odom_frame", odom_frame, "frame of the odometry");
    visitor.text("base_frame", base_frame, "frame of the robot");
    visitor.flag("publish_tf", publish_tf, "broadcast map_frame to odom_frame");
    visitor.number(
        "transform_tolerance", transform_tolerance,
        {"s",
         {0.0, 10.0},
         "the broadcast is dated this much after the scan, so that it serves until the next one"});
    visitor.number("odometry_timeout", odometry_timeout,
                   {"s",
                    {0.0, 60.0},
                    "how long a scan waits for the odometry to reach it before it is dropped"});
    visitor.number("map_resolution", map_resolution,
                   {"m", {0.005, 1.0}, "cell of the occupancy grid on the topic map"});
    visitor.numbers(
        "initial_pose", initial_pose,
        {"m, m, rad",
         {},
         "x, y and yaw of the robot at the start; without it the node waits for initialpose"});
    visitor.numbers("initial_sigma", initial_sigma,
                    {"m, rad", config::kNotNegative,
                     "standard deviations of position and heading of the start pose, also where "
                     "initialpose brings no covariance"});
    visitor.group("noise", noise);
    visitor.group("tracker", tracker);
  }
};

}  // namespace sightline::nodes
