#pragma once

#include <string>

#include "sightline/config/fields.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/scan/noise_model.h"

namespace sightline::nodes {

/// Parameters of the node laser_odometry.
struct LaserOdometryNodeConfig {
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  bool publish_tf = false;
  bool use_wheels = true;
  bool use_imu = true;
  double prior_timeout = 0.05;    ///< [s]
  double mounting_timeout = 2.0;  ///< [s]
  scan::NoiseModel noise;
  pipeline::ScanOdometryConfig odometry;

  void visit(config::FieldVisitor& visitor) {
    visitor.text("odom_frame", odom_frame, "frame of the pose");
    visitor.text("base_frame", base_frame, "frame of the robot, and of the twist");
    visitor.flag("publish_tf", publish_tf,
                 "broadcast odom_frame to base_frame; only where nobody else does");
    visitor.flag("use_wheels", use_wheels,
                 "take the topic odom, where it comes, as prior; not one's own output");
    visitor.flag("use_imu", use_imu,
                 "take the topic imu, where it comes: its turn rate as prior, and its attitude for "
                 "a scanner that leans");
    visitor.number("prior_timeout", prior_timeout,
                   {"s", {0.0, 10.0}, "how long a scan waits for a prior that has been coming"});
    visitor.number("mounting_timeout", mounting_timeout,
                   {"s",
                    {0.0, 60.0},
                    "how long the first scan waits for the transform from base_frame to its own; "
                    "after that the scanner is taken for the base"});
    visitor.group("noise", noise);
    visitor.group("odometry", odometry);
  }
};

}  // namespace sightline::nodes
