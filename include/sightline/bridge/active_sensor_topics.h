#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <sightline/HeadCommand.h>
#include "sightline/bridge/input_monitor.h"
#include "sightline/config/fields.h"
#include "sightline/driver/head_joint.h"
#include "sightline/motion/head_command.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::bridge {

/// Names of an active sensor's topics, frames and joint.
struct ActiveSensorNames {
  std::string range_scan = "range_scan";
  std::string scan = "scan";
  std::string joint_states = "joint_states";
  std::string head_command = "head_command";
  driver::HeadFrames frames;

  void visit(config::FieldVisitor& visitor);
};

/// Position of a head at one time.
struct HeadSample {
  std::int64_t stamp = 0;  ///< [ns]
  double angle = 0.0;      ///< of its joint [rad]
  double rate = 0.0;       ///< [rad/s]
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

  /// Makes publishHead() also tell tf where the head is in its mount, from now on.
  void broadcastHead() { broadcaster_.emplace(); }

  /// Publishes the range scan and the scan, both with the stamp that it carries [ns].
  void publish(motion::RangeScan& range_scan) const;
  /// Publishes where the head was: a joint state a sample, and one message of all to tf. Stamps
  /// rise.
  void publishHead(const std::vector<HeadSample>& samples);

  const ActiveSensorNames& names() const { return names_; }

 private:
  void publishJoint(const HeadSample& sample) const;
  void onHeadCommand(const HeadCommand& message);

  ActiveSensorNames names_;
  motion::HeadLimits limits_;
  InputMonitor monitor_;
  OnHeadCommand on_command_;
  ros::Publisher range_scan_publisher_;
  ros::Publisher scan_publisher_;
  ros::Publisher joint_publisher_;
  std::optional<tf2_ros::TransformBroadcaster> broadcaster_;
  ros::Subscriber command_subscriber_;
};

}  // namespace sightline::bridge
