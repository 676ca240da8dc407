#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "nodes/sim_sensor_config.h"
#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/odometry_conversion.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/run_clock.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/simulation.h"

namespace sightline::nodes {

namespace {

using simulation::Simulation;

class SimSensorNode {
 public:
  SimSensorNode(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  struct Scanner {
    SimScannerConfig config;
    ros::Publisher publisher;
  };

  struct ActiveSensor {
    SimActiveSensorConfig config;
    std::unique_ptr<bridge::ActiveSensorTopics> topics;
  };

  Simulation build() const;
  void addScanners(const config::Node& parameters);
  void claim(const char* what, const std::string& name, const config::Node& parameter);
  void addScanner(const SimScannerConfig& config);
  void addActiveSensors(const config::Node& parameters);
  void addActiveSensor(const SimActiveSensorConfig& config);
  void broadcastStatic(const std::string& parent, const std::string& child,
                       const Eigen::Isometry3d& T_parent_child);
  void startDriving();
  void onCommand(const geometry_msgs::Twist& command);
  void onTimer();
  void step();
  void publish(simulation::FinishedSweep& sweep);
  void publishRangeScans();
  void publishHead(std::size_t sensor);
  void publishState();
  geometry::UncertainTwist2 odometryTwist() const;
  void publishOdometry();
  void publishGroundTruth();
  void publishImu();
  void end();

  ros::NodeHandle node_;
  SimSensorConfig config_;
  Simulation simulation_;
  bridge::RunClock clock_;
  diagnostic_updater::Updater updater_;
  std::unique_ptr<bridge::InputMonitor> command_monitor_;
  tf2_ros::TransformBroadcaster broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_broadcaster_;
  std::vector<Scanner> scanners_;
  std::vector<ActiveSensor> active_sensors_;
  std::set<std::string> claimed_;  // names that only one may have
  std::int64_t odometry_messages_ = 0;
  geometry::StampedPose2 last_odometry_;  // stamp in time of the run

  ros::Publisher odometry_publisher_;
  ros::Publisher truth_publisher_;
  ros::Publisher imu_publisher_;  // of a person
  ros::Subscriber command_subscriber_;
  ros::WallTimer timer_;
  ros::WallTimer diagnostics_timer_;
  ros::WallTimer end_timer_;
};

SimSensorConfig readSimSensorConfig(const ros::NodeHandle& private_node) {
  const auto config = bridge::readParameters<SimSensorConfig>(private_node);
  const auto fail = [&](const char* key, const char* reason) {
    throw config::Error(private_node.getNamespace(), 0, key, reason);
  };
  if (config.world.empty()) fail("world", "has to name a world file");
  if (config.start_pose.size() != 3) fail("start_pose", "expected x, y and yaw");
  if (config.clock && !ros::Time::isSimTime()) fail("clock", "needs the parameter /use_sim_time");
  return config;
}

SimSensorNode::SimSensorNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : node_(node),
      config_(readSimSensorConfig(private_node)),
      simulation_(build()),
      clock_(config_.clock ? bridge::RunClock(node, config_.speed_factor) : bridge::RunClock()),
      updater_(node, private_node) {
  updater_.setHardwareID("none");
  const config::Node parameters = bridge::parametersBelow(private_node);
  addScanners(parameters);
  addActiveSensors(parameters);
  odometry_publisher_ = node_.advertise<nav_msgs::Odometry>("odom", 50);
  truth_publisher_ = node_.advertise<nav_msgs::Odometry>("ground_truth", 50);
  if (config_.walks) {
    simulation_.walk(config_.gait);
    imu_publisher_ = node_.advertise<sensor_msgs::Imu>("imu", 200);
  }
  startDriving();
  timer_ = node_.createWallTimer(ros::WallDuration(1e-9 * Simulation::kStep),
                                 [this](const ros::WallTimerEvent&) { onTimer(); });
  diagnostics_timer_ = node_.createWallTimer(
      ros::WallDuration(0.5), [this](const ros::WallTimerEvent&) { updater_.update(); });
}

Simulation SimSensorNode::build() const {
  const auto& start = config_.start_pose;
  return {world::World::readFile(config_.world), config_.robot,
          geometry::Pose2(start[0], start[1], start[2]), static_cast<std::uint64_t>(config_.seed)};
}

void SimSensorNode::addScanners(const config::Node& parameters) {
  if (!parameters.has("scanners")) {
    if (!parameters.has("active_sensors")) addScanner({});
    return;
  }
  for (const auto& [name, parameter] : parameters.at("scanners").entries()) {
    SimScannerConfig config;
    config::read(parameter, config);
    claim("topic", node_.resolveName(config.topic), parameter);
    claim("frame", config.frame, parameter);
    addScanner(config);
  }
}

void SimSensorNode::claim(const char* what, const std::string& name,
                          const config::Node& parameter) {
  if (!claimed_.insert(std::string(what) + " " + name).second) {
    parameter.fail(std::string("another scanner has the ") + what + " '" + name + "' already");
  }
}

void SimSensorNode::addScanner(const SimScannerConfig& config) {
  const auto profile = config.profile.empty()
                           ? simulation::ScannerProfile{}
                           : simulation::ScannerProfile::readFile(config.profile);
  simulation_.addScanner(profile, config.mounting);
  scanners_.push_back({config, node_.advertise<sensor_msgs::LaserScan>(config.topic, 50)});
  broadcastStatic(config_.base_frame, config.frame, config.mounting.T_base_sensor());
}

void SimSensorNode::addActiveSensors(const config::Node& parameters) {
  if (!parameters.has("active_sensors")) return;
  for (const auto& [name, parameter] : parameters.at("active_sensors").entries()) {
    SimActiveSensorConfig config;
    config::read(parameter, config);
    const bridge::ActiveSensorNames& names = config.names;
    for (const std::string& topic : {names.scan, names.range_scan, names.head_command}) {
      claim("topic", node_.resolveName(topic), parameter);
    }
    for (const std::string& frame : {names.mount_frame, names.head_frame, names.frame}) {
      claim("frame", frame, parameter);
    }
    claim("joint", names.joint, parameter);
    addActiveSensor(config);
  }
}

void SimSensorNode::addActiveSensor(const SimActiveSensorConfig& config) {
  const bridge::ActiveSensorNames& names = config.names;
  auto profile = config.profile.empty() ? simulation::ActiveSensorProfile{}
                                        : simulation::ActiveSensorProfile::readFile(config.profile);
  if (!config.urdf.empty()) {
    const driver::HeadFrames frames{names.joint, names.mount_frame, names.head_frame, names.frame};
    profile.takeHead(driver::HeadJoint::readFile(config.urdf, frames), config.urdf);
  }
  const std::size_t index = active_sensors_.size();
  simulation_.addActiveSensor(profile, config.mounting);
  auto topics = std::make_unique<bridge::ActiveSensorTopics>(
      node_, config.names, profile.head, updater_,
      [this, index](const motion::HeadCommand& command) {
        simulation_.commandHead(index, command);
      });
  active_sensors_.push_back({config, std::move(topics)});
  if (!config.publish_tf) return;
  broadcastStatic(config_.base_frame, names.mount_frame, config.mounting.T_base_sensor());
  // Where it is believed to be, which need not be where it is.
  const Eigen::Vector2d origin = simulation_.calibration(index).parameters.origin.position();
  broadcastStatic(names.head_frame, names.frame,
                  Eigen::Isometry3d(Eigen::Translation3d(origin.x(), origin.y(), 0.0)));
}

void SimSensorNode::broadcastStatic(const std::string& parent, const std::string& child,
                                    const Eigen::Isometry3d& T_parent_child) {
  const Eigen::Quaterniond rotation(T_parent_child.linear());
  geometry_msgs::TransformStamped message;
  message.header.stamp = ros::Time::now();
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.translation.x = T_parent_child.translation().x();
  message.transform.translation.y = T_parent_child.translation().y();
  message.transform.translation.z = T_parent_child.translation().z();
  message.transform.rotation.x = rotation.x();
  message.transform.rotation.y = rotation.y();
  message.transform.rotation.z = rotation.z();
  message.transform.rotation.w = rotation.w();
  static_broadcaster_.sendTransform(message);
}

void SimSensorNode::startDriving() {
  if (!config_.path.empty()) {
    simulation_.follow(simulation::Path::readFile(config_.path));
    return;
  }
  command_monitor_ = std::make_unique<bridge::InputMonitor>("cmd_vel", updater_);
  command_subscriber_ = node_.subscribe("cmd_vel", 10, &SimSensorNode::onCommand, this);
}

void SimSensorNode::onCommand(const geometry_msgs::Twist& command) {
  if (!std::isfinite(command.linear.x) || !std::isfinite(command.angular.z)) {
    command_monitor_->drop("a velocity that is not finite");
    return;
  }
  command_monitor_->accept();
  simulation_.command({command.linear.x, command.angular.z});
}

void SimSensorNode::onTimer() {
  const std::int64_t due = clock_.due(simulation_.time());
  const auto last = std::llround(1e9 * config_.duration);
  while (simulation_.time() + Simulation::kStep <= due) {
    if (last > 0 && simulation_.time() >= last) return end();
    step();
  }
}

void SimSensorNode::step() {
  if (simulation_.time() == 0) publishState();  // so that the first sweep is covered
  auto sweeps = simulation_.step();
  clock_.publish(simulation_.time());
  if (config_.walks) publishImu();
  for (auto& sweep : sweeps) publish(sweep);
  publishRangeScans();
  const double due = 1e9 * static_cast<double>(odometry_messages_) / config_.odometry_rate;
  if (static_cast<double>(simulation_.time()) >= due) publishState();
}

void SimSensorNode::publish(simulation::FinishedSweep& sweep) {
  const Scanner& scanner = scanners_[sweep.scanner];
  sweep.scan.stamp = clock_.stampOf(sweep.scan.stamp);
  sweep.scan.frame = scanner.config.frame;
  scanner.publisher.publish(bridge::toMessage(sweep.scan));
}

// After the head's position, so that tf reaches the end of the scan.
void SimSensorNode::publishRangeScans() {
  for (std::size_t i = 0; i < active_sensors_.size(); ++i) publishHead(i);
  for (simulation::FinishedRangeScan finished : simulation_.rangeScans()) {
    finished.range_scan.scan.stamp = clock_.stampOf(finished.range_scan.scan.stamp);
    active_sensors_[finished.sensor].topics->publish(finished.range_scan);
  }
}

void SimSensorNode::publishHead(std::size_t sensor) {
  const motion::SensorHead& head = simulation_.head(sensor);
  const bridge::ActiveSensorTopics& topics = *active_sensors_[sensor].topics;
  const std::int64_t stamp = clock_.stampOf(simulation_.time());
  topics.publishJoint(stamp, head.angle(), head.rate());
  if (!active_sensors_[sensor].config.publish_tf) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = bridge::timeOf(stamp);
  transform.header.frame_id = topics.names().mount_frame;
  transform.child_frame_id = topics.names().head_frame;
  transform.transform = bridge::toTransform({0.0, 0.0, head.angle()});
  broadcaster_.sendTransform(transform);
}

void SimSensorNode::publishState() {
  publishOdometry();
  publishGroundTruth();
  last_odometry_ = {simulation_.time(), simulation_.robot().odometry().pose().mean};
  ++odometry_messages_;
}

// What the wheels turned since the last message.
geometry::UncertainTwist2 SimSensorNode::odometryTwist() const {
  if (odometry_messages_ == 0) return {};
  const double time = 1e-9 * static_cast<double>(simulation_.time() - last_odometry_.stamp);
  const geometry::Pose2 step =
      geometry::between(last_odometry_.pose, simulation_.robot().odometry().pose().mean);
  return {step.log() / time, motion::stepCovariance(config_.robot.odometry, step) / (time * time)};
}

void SimSensorNode::publishOdometry() {
  const auto pose = simulation_.robot().odometry().pose();
  const auto message = bridge::toOdometryMessage(
      {clock_.stampOf(simulation_.time()), config_.odom_frame, config_.base_frame}, pose,
      odometryTwist());
  odometry_publisher_.publish(message);
  if (!config_.publish_tf) return;
  geometry_msgs::TransformStamped transform;
  transform.header = message.header;
  transform.child_frame_id = message.child_frame_id;
  transform.transform = bridge::toTransform(pose.mean);
  broadcaster_.sendTransform(transform);
}

void SimSensorNode::publishGroundTruth() {
  const simulation::Robot& robot = simulation_.robot();
  const Eigen::Vector3d twist(robot.velocity().linear, 0.0, robot.velocity().angular);
  truth_publisher_.publish(bridge::toOdometryMessage(
      {clock_.stampOf(simulation_.time()), config_.map_frame, config_.base_frame},
      {simulation_.T_map_base(simulation_.time()), Eigen::Matrix3d::Zero()},
      {twist, Eigen::Matrix3d::Zero()}));
}

// A perfect one, once a step.
void SimSensorNode::publishImu() {
  const std::int64_t now = simulation_.time();
  const auto& [roll, pitch] = simulation_.bodyMotion(now).attitude;
  const geometry::Pose2 turned = geometry::between(simulation_.T_map_base(now - Simulation::kStep),
                                                   simulation_.T_map_base(now));
  imu_publisher_.publish(
      bridge::toImuMessage(clock_.stampOf(now), config_.base_frame, {roll, pitch},
                           turned.theta() / (1e-9 * static_cast<double>(Simulation::kStep))));
}

void SimSensorNode::end() {
  if (simulation_.time() > last_odometry_.stamp)
    publishState();  // so that the last sweep is covered
  timer_.stop();
  // The others get a moment to take in what was published last.
  end_timer_ = node_.createWallTimer(
      ros::WallDuration(1.0), [](const ros::WallTimerEvent&) { ros::shutdown(); }, true);
}

}  // namespace

std::shared_ptr<void> makeSimSensor(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<SimSensorNode>(node, private_node);
}

}  // namespace sightline::nodes
