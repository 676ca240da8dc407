#include "sightline/bridge/active_sensor_topics.h"

#include <utility>

#include <sensor_msgs/LaserScan.h>

#include "sightline/bridge/range_scan_conversion.h"

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
                                       HeadTopics::OnCommand on_command)
    : names_(names),
      head_(node,
            {names.joint_states, names.head_command, names.frames.joint, names.frames.mount,
             names.frames.head},
            limits, updater, std::move(on_command)),
      range_scan_publisher_(node.advertise<RangeScan>(names.range_scan, 10)),
      scan_publisher_(node.advertise<sensor_msgs::LaserScan>(names.scan, 10)) {}

void ActiveSensorTopics::publish(motion::RangeScan& range_scan) const {
  range_scan.scan.frame = names_.frames.projection;
  range_scan.head.mount_frame = names_.frames.mount;
  const RangeScan message = toMessage(range_scan);
  range_scan_publisher_.publish(message);
  scan_publisher_.publish(toLaserScan(message));
}

}  // namespace sightline::bridge
