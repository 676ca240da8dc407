#pragma once

#include <string>
#include <vector>

#include "sightline/bridge/active_sensor_topics.h"
#include "sightline/config/fields.h"
#include "sightline/simulation/gait.h"
#include "sightline/simulation/robot.h"
#include "sightline/simulation/scanner.h"

namespace sightline::nodes {

/// Parameters of one scanner of the node sim_sensor, below ~scanners/NAME.
struct SimScannerConfig {
  std::string profile;  ///< path; empty: a Hokuyo UTM-30LX
  std::string topic = "scan";
  std::string frame = "laser";
  simulation::Mounting mounting;

  void visit(config::FieldVisitor& visitor) {
    visitor.path("profile", profile, "path of the scanner's profile; empty: Hokuyo UTM-30LX");
    visitor.text("topic", topic, "where the scans go");
    visitor.text("frame", frame, "frame of the scans");
    mounting.visit(visitor);
  }
};

/// Parameters of one active sensor of the node sim_sensor, below ~active_sensors/NAME.
struct SimActiveSensorConfig {
  std::string profile;  ///< path; empty: the sensor of pears
  std::string urdf;     ///< path
  bool publish_tf = true;
  bridge::ActiveSensorNames names;
  simulation::Mounting mounting;

  void visit(config::FieldVisitor& visitor) {
    visitor.path("profile", profile,
                 "path of the sensor's profile; empty: as config/sensors/synchronised_scan.yaml");
    visitor.path("urdf", urdf,
                 "path of a robot description with the limits of the head; empty: the profile's");
    visitor.flag("publish_tf", publish_tf,
                 "broadcast base_frame to mount_frame, that to head_frame, and that to frame; off "
                 "where robot_state_publisher does");
    names.visit(visitor);
    mounting.visit(visitor);
  }
};

/// Parameters of the node sim_sensor.
struct SimSensorConfig {
  std::string world;                        ///< path of the world file
  std::string path;                         ///< path of the path file; empty: cmd_vel drives
  std::vector<double> start_pose{0, 0, 0};  ///< x, y, yaw in the map [m, m, rad]
  int seed = 1;
  double duration = 0.0;        ///< [s]; 0: endless
  double odometry_rate = 50.0;  ///< [Hz]
  bool publish_tf = true;
  bool clock = false;
  double speed_factor = 1.0;
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  simulation::RobotConfig robot;
  bool walks = false;
  simulation::GaitConfig gait;

  void visit(config::FieldVisitor& visitor) {
    visitor.path("world", world, "path of the world file; must be set");
    visitor.path("path", path, "path of a file with a way to drive; without it cmd_vel drives");
    visitor.numbers(
        "start_pose", start_pose,
        {"m, m, rad", config::kCoordinate, "x, y and yaw of the robot in the map at the start"});
    visitor.integer("seed", seed, {"1", {0, 1e9}, "of all random errors"});
    visitor.number("duration", duration,
                   {"s", {0.0, 1e9}, "the node ends after so much of the run; 0: never"});
    visitor.number("odometry_rate", odometry_rate,
                   {"Hz", {1.0, 200.0}, "of odom, ground_truth and the transform of the odometry"});
    visitor.flag("publish_tf", publish_tf, "broadcast odom_frame to base_frame");
    visitor.flag("clock", clock, "be the clock of all nodes; needs use_sim_time");
    visitor.number("speed_factor", speed_factor,
                   {"1", {0.01, 100.0}, "as the clock: simulated seconds in a real one"});
    visitor.text("map_frame", map_frame, "frame of the world");
    visitor.text("odom_frame", odom_frame, "frame of the odometry");
    visitor.text("base_frame", base_frame, "frame of the robot");
    visitor.group("robot", robot);
    visitor.flag("walks", walks,
                 "a person carries the scanners where the robot would go, nodding and swaying; imu "
                 "tells how");
    visitor.group("gait", gait);
  }
};

}  // namespace sightline::nodes
