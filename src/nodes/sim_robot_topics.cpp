#include "nodes/sim_robot_topics.h"

#include <cmath>
#include <utility>

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>

#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/odometry_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::nodes {

namespace {

simulation::ActiveSensorProfile profileOf(const SimActiveSensorConfig& config) {
  auto profile = config.profile.empty() ? simulation::ActiveSensorProfile{}
                                        : simulation::ActiveSensorProfile::readFile(config.profile);
  if (!config.urdf.empty()) {
    profile.takeHead(driver::HeadJoint::readFile(config.urdf, config.names.frames), config.urdf);
  }
  return profile;
}

}  // namespace

SimRobotTopics::SimRobotTopics(const ros::NodeHandle& node, const SimRobotSetup& setup,
                               std::string map_frame, simulation::Simulation& simulation,
                               const bridge::RunClock& clock, diagnostic_updater::Updater& updater,
                               tf2_ros::StaticTransformBroadcaster& static_broadcaster)
    : node_(node, setup.name),
      config_(setup.config),
      name_(setup.name),
      map_frame_(std::move(map_frame)),
      carrier_(simulation.addRobot(config_.robot, config_.start_pose)),
      clock_(clock),
      updater_(updater),
      static_broadcaster_(static_broadcaster),
      odometry_publisher_(node_.advertise<nav_msgs::Odometry>("odom", 50)),
      truth_publisher_(node_.advertise<nav_msgs::Odometry>("ground_truth", 50)) {
  carrier_.setOdometryRate(config_.odometry_rate);
  for (const SimScannerConfig& scanner : setup.scanners) addScanner(scanner);
  for (const SimActiveSensorConfig& sensor : setup.active_sensors) addActiveSensor(sensor);
  if (config_.walks) {
    carrier_.walk(config_.gait);
    imu_publisher_ = node_.advertise<sensor_msgs::Imu>("imu", 200);
  }
  startDriving();
}

void SimRobotTopics::addScanner(const SimScannerConfig& config) {
  const auto profile = config.profile.empty()
                           ? simulation::ScannerProfile{}
                           : simulation::ScannerProfile::readFile(config.profile);
  scanners_.push_back({config, node_.advertise<sensor_msgs::LaserScan>(config.topic, 50), nullptr});
  if (!config.turret_urdf.empty()) return addTurret(profile, scanners_.back());
  carrier_.addScanner(profile, config.mounting, config.turret_rate);
  if (config.turret_rate != 0.0) return;
  broadcastStatic(config_.base_frame, config.frame, config.mounting.T_base_sensor());
}

void SimRobotTopics::addTurret(const simulation::ScannerProfile& profile, Scanner& scanner) {
  const SimScannerConfig& config = scanner.config;
  const driver::HeadFrames frames{config.turret_joint, "turret_mount", "turret", config.frame};
  const auto joint = driver::HeadJoint::readFile(config.turret_urdf, frames);
  const std::size_t index = scanners_.size() - 1;
  carrier_.addScanner(profile, config.mounting, joint.limits);
  const bridge::HeadNames names{"joint_states", "head_command", frames.joint, frames.mount,
                                frames.head};
  scanner.turret = std::make_unique<bridge::HeadTopics>(
      node_, names, joint.limits, updater_, [this, index](const motion::HeadCommand& command) {
        carrier_.commandTurret(index, command);
      });
  scanner.turret->broadcast();
  broadcastStatic(config_.base_frame, frames.mount, config.mounting.T_base_sensor());
  broadcastStatic(frames.head, config.frame, Eigen::Isometry3d::Identity());
}

void SimRobotTopics::addActiveSensor(const SimActiveSensorConfig& config) {
  const driver::HeadFrames& frames = config.names.frames;
  const auto profile = profileOf(config);
  const std::size_t index = active_sensors_.size();
  carrier_.addActiveSensor(profile, config.mounting);
  active_sensors_.push_back(std::make_unique<bridge::ActiveSensorTopics>(
      node_, config.names, profile.head, updater_,
      [this, index](const motion::HeadCommand& command) { carrier_.commandHead(index, command); }));
  if (!config.publish_tf) return;
  active_sensors_.back()->head().broadcast();
  broadcastStatic(config_.base_frame, frames.mount, config.mounting.T_base_sensor());
  // Place where the scan's origin is believed to be, which need not be where it is.
  const Eigen::Vector2d origin = carrier_.calibration(index).parameters.origin.position();
  broadcastStatic(frames.head, frames.projection,
                  Eigen::Isometry3d(Eigen::Translation3d(origin.x(), origin.y(), 0.0)));
}

void SimRobotTopics::broadcastStatic(const std::string& parent, const std::string& child,
                                     const Eigen::Isometry3d& T_parent_child) {
  static_broadcaster_.sendTransform(bridge::toTransformMessage(
      parent, child, bridge::nanoseconds(ros::Time::now()), T_parent_child));
}

void SimRobotTopics::startDriving() {
  if (!config_.path.empty()) {
    carrier_.follow(simulation::Path::readFile(config_.path));
    return;
  }
  const std::string topic = name_.empty() ? "cmd_vel" : name_ + "/cmd_vel";
  command_monitor_ = std::make_unique<bridge::InputMonitor>(topic, updater_);
  command_subscriber_ = node_.subscribe("cmd_vel", 10, &SimRobotTopics::onCommand, this);
}

void SimRobotTopics::onCommand(const geometry_msgs::Twist& command) {
  if (!std::isfinite(command.linear.x) || !std::isfinite(command.angular.z)) {
    command_monitor_->drop("a velocity that is not finite");
    return;
  }
  command_monitor_->accept();
  carrier_.command({command.linear.x, command.angular.z});
}

void SimRobotTopics::publish(const simulation::ReportedState& state) {
  if (state.stamp <= last_state_) return;
  last_state_ = state.stamp;
  if (state.stamp == 0) broadcastTurrets(0);  // so that the first sweep is covered
  const std::int64_t stamp = clock_.stampOf(state.stamp);
  odometry_publisher_.publish(bridge::toOdometryMessage(
      {stamp, config_.odom_frame, config_.base_frame}, state.pose, state.twist));
  if (config_.publish_tf) {
    broadcaster_.sendTransform(
        bridge::toTransformMessage(config_.odom_frame, config_.base_frame, stamp, state.pose.mean));
  }
  const Eigen::Vector3d velocity(state.velocity.linear, 0.0, state.velocity.angular);
  truth_publisher_.publish(bridge::toOdometryMessage({stamp, map_frame_, config_.base_frame},
                                                     {state.T_map_base, Eigen::Matrix3d::Zero()},
                                                     {velocity, Eigen::Matrix3d::Zero()}));
}

// A step has ended: turrets have turned, and what a person wears has moved.
void SimRobotTopics::publish(const simulation::ReportedMotion& motion) {
  broadcastTurrets(motion.stamp);
  if (!config_.walks) return;
  imu_publisher_.publish(bridge::toImuMessage(clock_.stampOf(motion.stamp), config_.base_frame,
                                              motion.attitude, motion.turn_rate));
}

void SimRobotTopics::broadcastTurrets(std::int64_t run_time) {
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    const SimScannerConfig& scanner = scanners_[i].config;
    if (scanners_[i].turret && run_time == 0) scanners_[i].turret->publish({{clock_.stampOf(0)}});
    if (scanner.turret_rate == 0.0) continue;
    broadcaster_.sendTransform(bridge::toTransformMessage(config_.base_frame, scanner.frame,
                                                          clock_.stampOf(run_time),
                                                          carrier_.T_base_sensor(i, run_time)));
  }
}

void SimRobotTopics::publish(simulation::FinishedSweep& sweep) {
  const Scanner& scanner = scanners_[sweep.scanner];
  sweep.scan.stamp = clock_.stampOf(sweep.scan.stamp);
  sweep.scan.frame = scanner.config.frame;
  scanner.publisher.publish(bridge::toMessage(sweep.scan));
}

void SimRobotTopics::publish(const simulation::ReportedHead& head) {
  active_sensors_[head.sensor]->head().publish(
      {{clock_.stampOf(head.stamp), head.angle, head.rate}});
}

void SimRobotTopics::publishTurret(const simulation::ReportedHead& turret) {
  scanners_[turret.sensor].turret->publish(
      {{clock_.stampOf(turret.stamp), turret.angle, turret.rate}});
}

void SimRobotTopics::publish(simulation::FinishedRangeScan& finished) {
  finished.range_scan.scan.stamp = clock_.stampOf(finished.range_scan.scan.stamp);
  active_sensors_[finished.sensor]->publish(finished.range_scan);
}

}  // namespace sightline::nodes
