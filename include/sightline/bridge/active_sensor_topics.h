#pragma once

#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "sightline/bridge/head_topics.h"
#include "sightline/config/fields.h"
#include "sightline/driver/head_joint.h"
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

/// The topics of an active sensor, be it real or simulated.
class ActiveSensorTopics {
 public:
  /// As HeadTopics takes them.
  ActiveSensorTopics(ros::NodeHandle node, const ActiveSensorNames& names,
                     const motion::HeadLimits& limits, diagnostic_updater::Updater& updater,
                     HeadTopics::OnCommand on_command);

  HeadTopics& head() { return head_; }
  /// Publishes the range scan and the scan, both with the stamp that it carries [ns].
  void publish(motion::RangeScan& range_scan) const;

 private:
  ActiveSensorNames names_;
  HeadTopics head_;
  ros::Publisher range_scan_publisher_;
  ros::Publisher scan_publisher_;
};

}  // namespace sightline::bridge
