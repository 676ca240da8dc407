#include <cmath>
#include <memory>
#include <string>
#include <thread>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "nodes/sync_scan_driver_config.h"
#include "sightline/bridge/active_sensor_topics.h"
#include "sightline/bridge/device_diagnostics.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/driver/device_session.h"
#include "sightline/driver/head_joint.h"
#include "sightline/driver/joint_samples.h"
#include "sightline/driver/scan_queue.h"
#include "sightline/triangulation/sensor_profile.h"

namespace sightline::nodes {

namespace {

constexpr std::int64_t kCorrection = 1'000'000'000;  // [ns]

class SyncScanDriverNode {
 public:
  SyncScanDriverNode(ros::NodeHandle node, ros::NodeHandle private_node);
  ~SyncScanDriverNode();
  SyncScanDriverNode(const SyncScanDriverNode&) = delete;
  SyncScanDriverNode& operator=(const SyncScanDriverNode&) = delete;

 private:
  void broadcastHead(const driver::HeadJoint& joint);
  void work();
  void publish(const triangulation::RawScan& raw);
  std::vector<bridge::HeadSample> headSamples(const triangulation::RawScan& raw);

  SyncScanDriverConfig config_;
  triangulation::Ranger ranger_;
  double sample_rate_;           // [Hz]
  std::int64_t head_stamp_ = 0;  // of the last sample that was published [ns]
  double head_angle_ = 0.0;      // in it [rad]
  diagnostic_updater::Updater updater_;
  driver::ScanQueue queue_{8};
  std::unique_ptr<driver::DeviceSession> session_;
  std::unique_ptr<bridge::DeviceDiagnostics> diagnostics_;
  std::unique_ptr<bridge::ActiveSensorTopics> topics_;
  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> static_broadcaster_;
  ros::SteadyTimer diagnostics_timer_;
  std::thread worker_;
};

triangulation::Calibration calibrationOf(const SyncScanDriverConfig& config) {
  if (!config.calibration.empty()) return triangulation::Calibration::readFile(config.calibration);
  if (!config.profile.empty()) {
    return triangulation::SensorProfile::readFile(config.profile).calibrated();
  }
  return triangulation::SensorProfile{}.calibrated();
}

driver::HeadJoint headJointOf(const SyncScanDriverConfig& config, const ros::NodeHandle& node,
                              const std::string& source) {
  const driver::HeadFrames& frames = config.names.frames;
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
      config_.session,
      driver::ExpectedDevice{sensor.serial, static_cast<std::size_t>(sensor.scan.beams),
                             1.0 / sensor.scan.sample_rate},
      joint.limits, [this](const triangulation::RawScan& raw) { queue_.push(raw); });
  topics_ = std::make_unique<bridge::ActiveSensorTopics>(
      node, config_.names, joint.limits, updater_,
      [this](const motion::HeadCommand& command) { session_->command(command); });
  if (config_.publish_tf) broadcastHead(joint);
  diagnostics_ = std::make_unique<bridge::DeviceDiagnostics>(
      config_.session, *session_, queue_, 1.0 / sensor.scan.scanPeriod(), updater_);
  diagnostics_timer_ = node.createSteadyTimer(
      ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { updater_.force_update(); });
  worker_ = std::thread([this] { work(); });
}

SyncScanDriverNode::~SyncScanDriverNode() {
  diagnostics_timer_.stop();
  queue_.close();
  worker_.join();
}

// The scan's origin as the robot description has it: where a robot_state_publisher broadcasts the
// fixed joint as well, tf hears the same twice.
void SyncScanDriverNode::broadcastHead(const driver::HeadJoint& joint) {
  const driver::HeadFrames& frames = config_.names.frames;
  topics_->head().broadcast();
  static_broadcaster_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
  static_broadcaster_->sendTransform(bridge::toTransformMessage(
      frames.head, frames.projection, bridge::nanoseconds(ros::Time::now()),
      Eigen::Isometry3d(
          Eigen::Translation3d(joint.scan_origin.x(), joint.scan_origin.y(), joint.scan_height))));
}

void SyncScanDriverNode::work() {
  while (const auto raw = queue_.pop()) {
    publish(*raw);
    topics_->head().publish(headSamples(*raw));
    diagnostics_->tick();
  }
}

void SyncScanDriverNode::publish(const triangulation::RawScan& raw) {
  motion::RangeScan range_scan = ranger_.range(raw);
  topics_->publish(range_scan);
}

// Leaves out samples that go back a little, which is a correction of the clock: tf would not take
// them.
std::vector<bridge::HeadSample> SyncScanDriverNode::headSamples(const triangulation::RawScan& raw) {
  std::vector<bridge::HeadSample> samples;
  for (const std::size_t i : driver::jointSamples(raw.head_angles, head_angle_, sample_rate_)) {
    const std::int64_t stamp =
        raw.stamp + std::llround(1e9 * static_cast<double>(i) / sample_rate_);
    head_angle_ = raw.head_angles[i];
    const bool goes_back = stamp <= head_stamp_ && head_stamp_ - stamp < kCorrection;
    if (goes_back) continue;
    samples.push_back({stamp, head_angle_, driver::jointRate(raw.head_angles, i, sample_rate_)});
    head_stamp_ = stamp;
  }
  return samples;
}

}  // namespace

std::shared_ptr<void> makeSyncScanDriver(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<SyncScanDriverNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
