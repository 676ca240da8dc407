#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include "nodes/sync_scan_driver_config.h"
#include "sightline/bridge/active_sensor_topics.h"
#include "sightline/bridge/device_diagnostics.h"
#include "sightline/bridge/parameters.h"
#include "sightline/driver/device_session.h"
#include "sightline/driver/head_joint.h"
#include "sightline/driver/joint_samples.h"
#include "sightline/driver/scan_queue.h"
#include "sightline/simulation/active_sensor_profile.h"

namespace sightline::nodes {

namespace {

// robot_state_publisher keeps one message waiting: what comes faster is lost to tf.
constexpr std::chrono::milliseconds kJointInterval{5};
constexpr std::int64_t kCorrection = 1'000'000'000;  // [ns]

class SyncScanDriverNode {
 public:
  SyncScanDriverNode(ros::NodeHandle node, ros::NodeHandle private_node);
  ~SyncScanDriverNode();
  SyncScanDriverNode(const SyncScanDriverNode&) = delete;
  SyncScanDriverNode& operator=(const SyncScanDriverNode&) = delete;

 private:
  void work();
  void publishJoint(const triangulation::RawScan& raw);
  void publish(const triangulation::RawScan& raw);

  SyncScanDriverConfig config_;
  triangulation::Ranger ranger_;
  double sample_rate_;            // [Hz]
  std::int64_t joint_stamp_ = 0;  // of the last joint state [ns]
  double head_angle_ = 0.0;       // in it [rad]
  diagnostic_updater::Updater updater_;
  driver::ScanQueue queue_{8};
  std::unique_ptr<driver::DeviceSession> session_;
  std::unique_ptr<bridge::DeviceDiagnostics> diagnostics_;
  std::unique_ptr<bridge::ActiveSensorTopics> topics_;
  ros::WallTimer diagnostics_timer_;
  std::thread worker_;
};

triangulation::Calibration calibrationOf(const SyncScanDriverConfig& config) {
  if (!config.calibration.empty()) return triangulation::Calibration::readFile(config.calibration);
  if (!config.profile.empty()) {
    return simulation::ActiveSensorProfile::readFile(config.profile).calibrated();
  }
  return simulation::ActiveSensorProfile{}.calibrated();
}

driver::HeadJoint headJointOf(const SyncScanDriverConfig& config, const ros::NodeHandle& node,
                              const std::string& source) {
  const bridge::ActiveSensorNames& names = config.names;
  const driver::HeadFrames frames{names.joint, names.mount_frame, names.head_frame, names.frame};
  if (!config.urdf.empty()) return driver::HeadJoint::readFile(config.urdf, frames);
  std::string key;
  std::string xml;
  if (!node.searchParam("robot_description", key) || !node.getParam(key, xml)) {
    throw config::Error(source, 0, "urdf", "names no file, and there is no robot_description");
  }
  return driver::HeadJoint::fromUrdf(xml, frames, key);
}

SyncScanDriverNode::SyncScanDriverNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : config_(bridge::readParameters<SyncScanDriverConfig>(private_node)),
      ranger_(calibrationOf(config_)),
      sample_rate_(ranger_.calibration().parameters.scan.sample_rate),
      updater_(node, private_node, private_node.getNamespace()) {
  const triangulation::SensorParameters& sensor = ranger_.calibration().parameters;
  const auto joint = headJointOf(config_, node, private_node.getNamespace());
  joint.requireScanOrigin(sensor.origin.position(), "robot description");
  updater_.setHardwareID(sensor.serial);
  if (config_.calibration.empty()) {
    ROS_WARN("no calibration file: ranges are as the profile of %s has them",
             sensor.serial.c_str());
  }
  session_ = std::make_unique<driver::DeviceSession>(
      config_.session, sensor.serial, static_cast<std::size_t>(sensor.scan.beams),
      [this](const triangulation::RawScan& raw) { queue_.push(raw); });
  topics_ = std::make_unique<bridge::ActiveSensorTopics>(
      node, config_.names, joint.limits, updater_,
      [this](const motion::HeadCommand& command) { session_->command(command); });
  diagnostics_ = std::make_unique<bridge::DeviceDiagnostics>(
      config_.session, *session_, queue_, 1.0 / sensor.scan.scanPeriod(), updater_);
  diagnostics_timer_ = node.createWallTimer(
      ros::WallDuration(0.5), [this](const ros::WallTimerEvent&) { updater_.update(); });
  worker_ = std::thread([this] { work(); });
}

SyncScanDriverNode::~SyncScanDriverNode() {
  diagnostics_timer_.stop();
  queue_.close();
  worker_.join();
}

void SyncScanDriverNode::work() {
  while (const auto raw = queue_.pop()) {
    publishJoint(*raw);
    publish(*raw);
  }
}

// Ahead of the scan, so that tf knows how the head turned when it is asked.
void SyncScanDriverNode::publishJoint(const triangulation::RawScan& raw) {
  for (const std::size_t i : driver::jointSamples(raw.head_angles, head_angle_, sample_rate_)) {
    if (i > 0 && raw.head_angles[i] != head_angle_) std::this_thread::sleep_for(kJointInterval);
    const std::int64_t stamp =
        raw.stamp + std::llround(1e9 * static_cast<double>(i) / sample_rate_);
    head_angle_ = raw.head_angles[i];
    // What goes back a little is a correction of the clock, which tf would not take.
    const bool goes_back = stamp <= joint_stamp_ && joint_stamp_ - stamp < kCorrection;
    if (goes_back) continue;
    topics_->publishJoint(stamp, head_angle_, driver::jointRate(raw.head_angles, i, sample_rate_));
    joint_stamp_ = stamp;
  }
}

void SyncScanDriverNode::publish(const triangulation::RawScan& raw) {
  motion::RangeScan range_scan = ranger_.range(raw);
  topics_->publish(range_scan);
  diagnostics_->tick();
}

}  // namespace

std::shared_ptr<void> makeSyncScanDriver(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<SyncScanDriverNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
