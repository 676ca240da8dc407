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
#include "sightline/motion/head_command.h"

namespace sightline::bridge {

/// Names of a head's topics, frames and joint.
struct HeadNames {
  std::string joint_states;
  std::string head_command;
  std::string joint;
  std::string mount;  ///< frame that the head turns in, about its z axis
  std::string head;   ///< the same frame, turned
};

/// Position of a head at one time.
struct HeadSample {
  std::int64_t stamp = 0;  ///< [ns]
  double angle = 0.0;      ///< of its joint [rad]
  double rate = 0.0;       ///< [rad/s]
};

/// The topics of a head that turns a sensor, be it real or simulated.
class HeadTopics {
 public:
  using OnCommand = std::function<void(const motion::HeadCommand&)>;

  /// Commands that the limits allow are handed on; the others are dropped with their reason, which
  /// the updater shows. The updater has to live as long.
  HeadTopics(ros::NodeHandle node, const HeadNames& names, const motion::HeadLimits& limits,
             diagnostic_updater::Updater& updater, OnCommand on_command);

  /// Makes publish() also tell tf where the head is in its mount, from now on.
  void broadcast() { broadcaster_.emplace(); }
  /// Publishes where the head was: a joint state a sample, and one message of all to tf. Stamps
  /// rise.
  void publish(const std::vector<HeadSample>& samples);

 private:
  void publishJoint(const HeadSample& sample) const;
  void onCommand(const HeadCommand& message);

  HeadNames names_;
  motion::HeadLimits limits_;
  InputMonitor monitor_;
  OnCommand on_command_;
  ros::Publisher joint_publisher_;
  std::optional<tf2_ros::TransformBroadcaster> broadcaster_;
  ros::Subscriber command_subscriber_;
};

}  // namespace sightline::bridge
