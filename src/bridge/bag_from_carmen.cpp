#include "sightline/bridge/bag_from_carmen.h"

#include <cmath>
#include <cstdlib>
#include <limits>

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/logs/carmen_odometry.h"
#include "sightline/logs/carmen_stamps.h"

namespace sightline::bridge {

namespace {

constexpr const char* kOdomFrame = "odom";
constexpr const char* kBaseFrame = "base_link";
constexpr const char* kLaserFrame = "laser";
// A SICK LMS reports its faults, among them that nothing came back, as ranges from 81 m on.
constexpr double kSickFault = 81.0;

double frontLaserMax(const logs::CarmenLog& log) {
  const auto found = log.parameters.find("robot_front_laser_max");
  if (found == log.parameters.end()) return kSickFault;
  const double stated = std::strtod(found->second.c_str(), nullptr);
  return stated > 0.0 && stated < kSickFault ? stated : kSickFault;
}

float rosRange(float reading, double range_max) {
  if (static_cast<double>(reading) >= range_max) return std::numeric_limits<float>::infinity();
  return reading > 0.0F ? reading : std::numeric_limits<float>::quiet_NaN();
}

sensor_msgs::LaserScan scanOf(const logs::CarmenLaser& laser, std::int64_t stamp,
                              double front_laser_max) {
  const double range_max = laser.range_max.value_or(front_laser_max);
  sensor_msgs::LaserScan scan;
  scan.header = headerOf(stamp, kLaserFrame);
  scan.angle_min = static_cast<float>(laser.angle_min);
  scan.angle_increment = static_cast<float>(laser.angle_increment);
  const auto last = static_cast<double>(laser.ranges.size() - 1);
  scan.angle_max = static_cast<float>(laser.angle_min + last * laser.angle_increment);
  scan.range_max = static_cast<float>(range_max);
  scan.ranges.reserve(laser.ranges.size());
  for (const float reading : laser.ranges) scan.ranges.push_back(rosRange(reading, range_max));
  scan.intensities = laser.remissions;
  return scan;
}

nav_msgs::Odometry odometryMessage(const logs::CarmenOdometry& odometry, const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = kOdomFrame;
  message.child_frame_id = kBaseFrame;
  message.pose.pose = toPose(odometry.robot);
  message.twist.twist.linear.x = odometry.velocity.translation;
  message.twist.twist.angular.z = odometry.velocity.rotation;
  return message;
}

class CarmenBag {
 public:
  CarmenBag(const std::string& path, const CarmenBagOptions& options, double front_laser_max)
      : bag_(path, rosbag::bagmode::Write),
        delay_(std::llround(options.odometry_delay * 1e9)),
        T_base_laser_(options.laser_offset, 0.0, 0.0),
        front_laser_max_(front_laser_max) {}

  std::int64_t stampOf(const logs::CarmenOdometry& odometry) const {
    return odometry.stamp + delay_;
  }

  void write(const logs::CarmenLaser& laser, std::int64_t stamp) {
    bag_.write("/scan", timeOf(stamp), scanOf(laser, stamp, front_laser_max_));
    stamps_.push_back({stamp, laser.stamp});
  }

  void write(const logs::CarmenOdometry& odometry) {
    const ros::Time stamp = timeOf(stampOf(odometry));
    tf2_msgs::TFMessage transforms;
    transforms.transforms = {
        toTransformMessage(kOdomFrame, kBaseFrame, nanoseconds(stamp), odometry.robot),
        toTransformMessage(kBaseFrame, kLaserFrame, nanoseconds(stamp), T_base_laser_)};
    bag_.write("/tf", stamp, transforms);
    bag_.write("/odom", stamp, odometryMessage(odometry, stamp));
  }

  void close() {
    const std::string path = bag_.getFileName();
    bag_.close();
    logs::writeStamps(path + ".stamps", stamps_);
  }

 private:
  rosbag::Bag bag_;
  std::int64_t delay_;
  geometry::Pose2 T_base_laser_;
  double front_laser_max_;
  std::vector<logs::StampPair> stamps_;
};

std::vector<logs::CarmenOdometry> preparedOdometry(const logs::CarmenLog& log,
                                                   const CarmenBagOptions& options) {
  auto odometry = logs::odometryOf(log);
  if (!options.reverse_from_tv) return odometry;
  if (!logs::hasVelocity(log)) {
    throw config::Error("", 0, "reverse_from_tv", "the log states no velocity to repair it from");
  }
  logs::reverseFromVelocity(odometry);
  return odometry;
}

}  // namespace

void CarmenBagOptions::visit(config::FieldVisitor& visitor) {
  visitor.flag("reverse_from_tv", reverse_from_tv,
               "turn odometry steps round where the velocity is negative");
  visitor.number("odometry_delay", odometry_delay,
                 {"s", {-10.0, 10.0}, "by how much the odometry is stamped later"});
  visitor.number("laser_offset", laser_offset,
                 {"m", {-10.0, 10.0}, "how far the laser sits ahead of base_link"});
}

CarmenBagContents writeCarmenBag(const logs::CarmenLog& log, const CarmenBagOptions& options,
                                 const std::string& path) {
  config::validate(options);
  if (log.scans.empty()) {
    throw config::Error("", 0, "", "no scans in the log: neither FLASER nor ROBOTLASER1");
  }
  const auto odometry = preparedOdometry(log, options);
  CarmenBag bag(path, options, frontLaserMax(log));
  const std::vector<std::int64_t> stamps = logs::risingStamps(log);
  auto next = odometry.begin();
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    for (; next != odometry.end() && bag.stampOf(*next) <= stamps[i]; ++next) bag.write(*next);
    bag.write(log.scans[i], stamps[i]);
  }
  for (; next != odometry.end(); ++next) bag.write(*next);
  bag.close();
  return {log.scans.size(), odometry.size(), logs::countNotRising(log)};
}

}  // namespace sightline::bridge
