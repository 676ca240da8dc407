#pragma once

#include <memory>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "nodes/sim_sensor_setup.h"
#include "sightline/bridge/active_sensor_topics.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/run_clock.h"
#include "sightline/simulation/simulation.h"

namespace sightline::nodes {

/// The topics of one robot of sim_sensor, and what it is told.
class SimRobotTopics {
 public:
  /// Adds the robot to the simulation and tells tf how its sensors are mounted. All that is handed
  /// over has to live as long. Throws config::Error.
  SimRobotTopics(const ros::NodeHandle& node, const SimRobotSetup& setup, std::string map_frame,
                 simulation::Simulation& simulation, const bridge::RunClock& clock,
                 diagnostic_updater::Updater& updater,
                 tf2_ros::StaticTransformBroadcaster& static_broadcaster);

  /// Does nothing at a time that was told already.
  void publish(const simulation::ReportedState& state);
  void publish(const simulation::ReportedMotion& motion);
  void publish(simulation::FinishedSweep& sweep);
  void publish(const simulation::ReportedHead& head);
  void publishTurret(const simulation::ReportedHead& turret);
  void publish(simulation::FinishedRangeScan& finished);

 private:
  struct Scanner {
    SimScannerConfig config;
    ros::Publisher publisher;
    std::unique_ptr<bridge::HeadTopics> turret;  // that is commanded; none otherwise
  };

  void addScanner(const SimScannerConfig& config);
  void addTurret(const simulation::ScannerProfile& profile, Scanner& scanner);
  void addActiveSensor(const SimActiveSensorConfig& config);
  void broadcastStatic(const std::string& parent, const std::string& child,
                       const Eigen::Isometry3d& T_parent_child);
  void startDriving();
  void onCommand(const geometry_msgs::Twist& command);
  void broadcastTurrets(std::int64_t run_time);

  ros::NodeHandle node_;
  SimRobotConfig config_;
  std::string name_;
  std::string map_frame_;
  simulation::Carrier& carrier_;
  const bridge::RunClock& clock_;
  diagnostic_updater::Updater& updater_;
  tf2_ros::StaticTransformBroadcaster& static_broadcaster_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::unique_ptr<bridge::InputMonitor> command_monitor_;
  std::vector<Scanner> scanners_;
  std::vector<std::unique_ptr<bridge::ActiveSensorTopics>> active_sensors_;
  std::int64_t last_state_ = -1;  // in time of the run [ns]
  ros::Publisher odometry_publisher_;
  ros::Publisher truth_publisher_;
  ros::Publisher imu_publisher_;  // of a person
  ros::Subscriber command_subscriber_;
};

}  // namespace sightline::nodes
