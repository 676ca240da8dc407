#include "sightline/bridge/motion_inputs.h"

#include <stdexcept>

#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/pipeline/scan_motion.h"

namespace sightline::bridge {

namespace {

// An input that has been silent for longer is not waited for [ns].
constexpr std::int64_t kSilence = 1'000'000'000;

bool lags(std::int64_t newest, std::int64_t stamp) {
  return newest < stamp && stamp - newest < kSilence;
}

}  // namespace

MotionInputs::MotionInputs(ros::NodeHandle node, Settings settings,
                           const tf2_ros::Buffer& transforms, diagnostic_updater::Updater& updater)
    : settings_(std::move(settings)), transforms_(transforms), updater_(updater) {
  const ros::TransportHints at_once = ros::TransportHints().tcpNoDelay();
  // Where the laser odometry takes the place of odom it is no prior of its own.
  if (settings_.use_wheels && node.resolveName("odom") != node.resolveName("laser_odom")) {
    wheels_input_.subscriber = node.subscribe("odom", 200, &MotionInputs::onWheels, this, at_once);
  }
  if (settings_.use_imu) {
    imu_input_.subscriber = node.subscribe("imu", 500, &MotionInputs::onImu, this, at_once);
  }
}

InputMonitor& MotionInputs::monitorOf(Input& input) {
  if (!input.monitor) {
    input.monitor = std::make_unique<InputMonitor>(input.subscriber.getTopic(), updater_);
  }
  return *input.monitor;
}

void MotionInputs::onWheels(const nav_msgs::Odometry& message) {
  InputMonitor& monitor = monitorOf(wheels_input_);
  const geometry::Pose2 pose = toPose2(message.pose.pose);
  if (message.header.stamp.isZero()) return monitor.drop("a stamp of zero");
  if (!pose.isFinite()) return monitor.drop("a pose that is not finite");
  monitor.accept();
  wheels_.add(nanoseconds(message.header.stamp), pose);
}

void MotionInputs::onImu(const sensor_msgs::Imu& message) {
  InputMonitor& monitor = monitorOf(imu_input_);
  try {
    imu_.add(readImu(message, rotationToBase(message.header.frame_id)));
    monitor.accept();
  } catch (const std::invalid_argument& fault) {
    monitor.drop(fault.what());
  }
}

// A sensor that no transform leads to is taken to sit straight on the base.
Eigen::Quaterniond MotionInputs::rotationToBase(const std::string& frame) const {
  try {
    const auto q =
        transforms_.lookupTransform(settings_.base_frame, frame, ros::Time(0)).transform.rotation;
    return {q.w, q.x, q.y, q.z};
  } catch (const tf2::TransformException&) {
    return Eigen::Quaterniond::Identity();
  }
}

bool MotionInputs::isBehind(std::int64_t stamp) const {
  const bool wheels_lag = !wheels_.empty() && lags(wheels_.newest(), stamp);
  const auto newest_imu = imu_.newest();
  return wheels_lag || (newest_imu && lags(*newest_imu, stamp));
}

pipeline::OdometryAids MotionInputs::aidsFor(scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                                             std::optional<std::int64_t> before) const {
  pipeline::OdometryAids aids;
  aids.T_odom_base = pipeline::addMotion(
      scan, [this](std::int64_t stamp) { return wheels_.at(stamp); }, T_base_sensor);
  if (before) aids.turn = imu_.turn(*before, scan.stamp);
  const auto end = scan.stamp + std::llround(1e9 * scan.geometry()->timeOffsets().back());
  const auto first = imu_.attitude(scan.stamp);
  const auto last = imu_.attitude(end);
  if (first && last) {
    const double yaw = T_base_sensor.theta();
    aids.attitude = motion::SweepAttitude{first->seenFrom(yaw), last->seenFrom(yaw)};
  }
  return aids;
}

}  // namespace sightline::bridge
