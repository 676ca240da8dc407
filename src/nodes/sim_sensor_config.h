#pragma once

#include <string>

#include "sightline/bridge/active_sensor_topics.h"
#include "sightline/config/fields.h"
#include "sightline/simulation/body.h"
#include "sightline/simulation/gait.h"
#include "sightline/simulation/mounting.h"
#include "sightline/simulation/robot.h"

namespace sightline::nodes {

/// Parameters of one scanner of the node sim_sensor, below ~scanners/NAME.
struct SimScannerConfig {
  std::string profile;  ///< path; empty: a Hokuyo UTM-30LX
  std::string topic = "scan";
  std::string frame = "laser";
  simulation::Mounting mounting;
  double turret_rate = 0.0;  ///< [rad/s]
  std::string turret_urdf;   ///< path
  std::string turret_joint = "turret_joint";

  void visit(config::FieldVisitor& visitor) {
    visitor.path("profile", profile, "path of the scanner's profile; empty: Hokuyo UTM-30LX");
    visitor.text("topic", topic, "where the scans go");
    visitor.text("frame", frame, "frame of the scans");
    mounting.visit(visitor);
    visitor.number("turret_rate", turret_rate,
                   {"rad/s",
                    {-100.0, 100.0},
                    "of a turret that carries the scanner and turns about its z axis; 0: fixed"});
    visitor.path("turret_urdf", turret_urdf,
                 "path of a robot description whose joint turns a turret that carries the scanner, "
                 "as head_command says; empty: none");
    visitor.text("turret_joint", turret_joint, "of that turret; its links turret_mount and turret");
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

/// Parameters of one robot of the node sim_sensor: the node's own, or those below ~robots/NAME.
struct SimRobotConfig {
  std::string path;             ///< path of the path file; empty: cmd_vel drives
  geometry::Pose2 start_pose;   ///< T_map_base, or of the body
  double odometry_rate = 50.0;  ///< [Hz]
  bool publish_tf = true;
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  simulation::RobotConfig robot;
  bool walks = false;
  simulation::GaitConfig gait;

  void visit(config::FieldVisitor& visitor) {
    visitor.path("path", path, "path of a file with the robot's path; without it cmd_vel drives");
    visitor.pose("start_pose", start_pose, "of the robot in the map at the start");
    visitor.number("odometry_rate", odometry_rate,
                   {"Hz", {1.0, 200.0}, "of odom, ground_truth and the transform of the odometry"});
    visitor.flag("publish_tf", publish_tf, "broadcast odom_frame to base_frame");
    visitor.text("odom_frame", odom_frame, "frame of the odometry");
    visitor.text("base_frame", base_frame, "frame of the robot");
    visitor.group("robot", robot);
    visitor.flag("walks", walks,
                 "a person carries the scanners where the robot would go, nodding and swaying; the "
                 "motion is on imu");
    visitor.group("gait", gait);
  }
};

/// Parameters of the node sim_sensor.
struct SimSensorConfig {
  std::string world;  ///< path of the world file
  int seed = 1;
  double duration = 0.0;  ///< [s]; 0: endless
  bool clock = false;
  double speed_factor = 1.0;
  std::string map_frame = "map";
  std::string truth;  ///< path of a table of targets; empty: none

  void visit(config::FieldVisitor& visitor) {
    visitor.path("world", world, "path of the world file; must be set");
    visitor.path("truth", truth,
                 "table `kind,id,x,y` of the targets in the world, for target_truth; empty: none");
    visitor.integer("seed", seed, {"1", {0, 1e9}, "of all random errors"});
    visitor.number("duration", duration,
                   {"s", {0.0, 1e9}, "the node ends after so much of the run; 0: never"});
    visitor.flag("clock", clock, "be the clock of all nodes; needs use_sim_time");
    visitor.number("speed_factor", speed_factor,
                   {"1", {0.01, 100.0}, "as the clock: simulated seconds in a real one"});
    visitor.text("map_frame", map_frame, "frame of the world");
  }
};

/// Parameters of one thing that moves through the world of sim_sensor, below ~movers/NAME.
struct SimMoverConfig {
  std::string path;            ///< path of the path file
  geometry::Pose2 start_pose;  ///< T_map_base, or of the body
  simulation::Body body;

  void visit(config::FieldVisitor& visitor) {
    visitor.path("path", path, "path of a file with its path through the world; must be set");
    visitor.pose("start_pose", start_pose, "in the map at the start");
    body.visit(visitor);
  }
};

}  // namespace sightline::nodes
