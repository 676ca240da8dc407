#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <sightline/HeadCommand.h>
#include "sightline/bridge/input_monitor.h"
#include "sightline/config/fields.h"
#include "sightline/motion/head_command.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::bridge {

/// What an active sensor's topics, frames and joint are called.
struct ActiveSensorNames {
  std::string range_scan = "range_scan";
  std::string scan = "scan";
  std::string joint_states = "joint_states";
  std::string head_command = "head_command";
  std::string joint = "head_joint";
  std::string mount_frame = "active_sensor";
  std::string head_frame = "head";
  std::string frame = "projection";

  void visit(config::FieldVisitor& visitor);
};

/// The topics of an active sensor, be it real or simulated.
class ActiveSensorTopics {
 public:
  using OnHeadCommand = std::function<void(const motion::HeadCommand&)>;

  /// Head commands that the limits allow are handed on; the others are dropped with their reason,
  /// which the updater shows. The updater has to live as long.
  ActiveSensorTopics(ros::NodeHandle node, const ActiveSensorNames& names,
                     const motion::HeadLimits& limits, diagnostic_updater::Updater& updater,
                     OnHeadCommand on_command);

  /// Publishes the range scan and the scan, both with the stamp that it carries [ns].
  void publish(motion::RangeScan& range_scan) const;
  /// Publishes the head's position [rad] and rate [rad/s] at a time [ns].
  void publishJoint(std::int64_t stamp, double position, double rate) const;

  const ActiveSensorNames& names() const { return names_; }

 private:
  void onHeadCommand(const HeadCommand& message);

  ActiveSensorNames names_;
  motion::HeadLimits limits_;
  InputMonitor monitor_;
  OnHeadCommand on_command_;
  ros::Publisher range_scan_publisher_;
  ros::Publisher scan_publisher_;
  ros::Publisher joint_publisher_;
  ros::Subscriber command_subscriber_;
};

}  // namespace sightline::bridge
