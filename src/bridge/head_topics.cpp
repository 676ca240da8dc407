#include "sightline/bridge/head_topics.h"

#include <utility>

#include <sensor_msgs/JointState.h>

#include "sightline/bridge/head_command_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

HeadTopics::HeadTopics(ros::NodeHandle node, const HeadNames& names,
                       const motion::HeadLimits& limits, diagnostic_updater::Updater& updater,
                       OnCommand on_command)
    : names_(names),
      limits_(limits),
      monitor_(node.resolveName(names.head_command), updater, InputMonitor::Flow::kPerhaps),
      on_command_(std::move(on_command)),
      joint_publisher_(node.advertise<sensor_msgs::JointState>(names.joint_states, 100)),
      command_subscriber_(node.subscribe(names.head_command, 10, &HeadTopics::onCommand, this)) {}

void HeadTopics::publish(const std::vector<HeadSample>& samples) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const HeadSample& sample : samples) {
    transforms.push_back(toTransformMessage(names_.mount, names_.head, sample.stamp,
                                            geometry::Pose2(0.0, 0.0, sample.angle)));
  }
  if (broadcaster_ && !transforms.empty()) broadcaster_->sendTransform(transforms);
  for (const HeadSample& sample : samples) publishJoint(sample);
}

void HeadTopics::publishJoint(const HeadSample& sample) const {
  sensor_msgs::JointState message;
  message.header.stamp = timeOf(sample.stamp);
  message.name = {names_.joint};
  message.position = {sample.angle};
  message.velocity = {sample.rate};
  joint_publisher_.publish(message);
}

// Several heads may hear one topic; each obeys what names its joint, or none.
void HeadTopics::onCommand(const HeadCommand& message) {
  if (!message.joint.empty() && message.joint != names_.joint) return;
  try {
    on_command_(fromMessage(message, names_.joint, limits_));
    monitor_.accept();
  } catch (const InvalidHeadCommand& fault) {
    monitor_.drop(fault.what());
  }
}

}  // namespace sightline::bridge
