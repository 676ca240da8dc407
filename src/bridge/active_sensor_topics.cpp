#include "sightline/bridge/active_sensor_topics.h"

#include <utility>

#include <sensor_msgs/JointState.h>

#include "sightline/bridge/head_command_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/range_scan_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

void ActiveSensorNames::visit(config::FieldVisitor& visitor) {
  visitor.text("range_scan", range_scan, "topic of the scans with variances and head angles");
  visitor.text("scan", scan, "topic of the same scans as sensor_msgs/LaserScan");
  visitor.text("joint_states", joint_states, "topic of the head's position");
  visitor.text("head_command", head_command, "topic of commands to the head");
  frames.visit(visitor);
}

ActiveSensorTopics::ActiveSensorTopics(ros::NodeHandle node, const ActiveSensorNames& names,
                                       const motion::HeadLimits& limits,
                                       diagnostic_updater::Updater& updater,
                                       OnHeadCommand on_command)
    : names_(names),
      limits_(limits),
      monitor_(node.resolveName(names.head_command), updater, InputMonitor::Flow::kPerhaps),
      on_command_(std::move(on_command)),
      range_scan_publisher_(node.advertise<RangeScan>(names.range_scan, 10)),
      scan_publisher_(node.advertise<sensor_msgs::LaserScan>(names.scan, 10)),
      joint_publisher_(node.advertise<sensor_msgs::JointState>(names.joint_states, 100)),
      command_subscriber_(
          node.subscribe(names.head_command, 10, &ActiveSensorTopics::onHeadCommand, this)) {}

void ActiveSensorTopics::publish(motion::RangeScan& range_scan) const {
  range_scan.scan.frame = names_.frames.projection;
  range_scan.head.mount_frame = names_.frames.mount;
  const RangeScan message = toMessage(range_scan);
  range_scan_publisher_.publish(message);
  scan_publisher_.publish(toLaserScan(message));
}

void ActiveSensorTopics::publishHead(const std::vector<HeadSample>& samples) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const HeadSample& sample : samples) {
    transforms.push_back(toTransformMessage(names_.frames.mount, names_.frames.head, sample.stamp,
                                            geometry::Pose2(0.0, 0.0, sample.angle)));
  }
  if (broadcaster_ && !transforms.empty()) broadcaster_->sendTransform(transforms);
  for (const HeadSample& sample : samples) publishJoint(sample);
}

void ActiveSensorTopics::publishJoint(const HeadSample& sample) const {
  sensor_msgs::JointState message;
  message.header.stamp = timeOf(sample.stamp);
  message.name = {names_.frames.joint};
  message.position = {sample.angle};
  message.velocity = {sample.rate};
  joint_publisher_.publish(message);
}

// Several heads may hear one topic; each obeys what names its joint, or none.
void ActiveSensorTopics::onHeadCommand(const HeadCommand& message) {
  if (!message.joint.empty() && message.joint != names_.frames.joint) return;
  try {
    on_command_(fromMessage(message, names_.frames.joint, limits_));
    monitor_.accept();
  } catch (const InvalidHeadCommand& fault) {
    monitor_.drop(fault.what());
  }
}

}  // namespace sightline::bridge
