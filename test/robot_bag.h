#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/scanner.h"

/// The recording of a robot that drives an oval around a box in a room of 6 x 4 m, with whatever
/// robots of other people do to their messages.
namespace sightline::test {

constexpr const char* kRobotRooms = "rooms:\n  hall: {size: [6.0, 4.0]}\n";
constexpr const char* kRobotWorld =
    "segments:\n"
    "  - {from: [-3.0, -2.0], to: [3.0, -2.0]}\n"
    "  - {from: [3.0, -2.0], to: [3.0, 2.0]}\n"
    "  - {from: [3.0, 2.0], to: [-3.0, 2.0]}\n"
    "  - {from: [-3.0, 2.0], to: [-3.0, -2.0]}\n"
    "boxes:\n"
    "  - {centre: [-0.3, 0.1], size: [0.5, 0.4], yaw: 0.3}\n";

/// Time of the recording's first moment [s].
constexpr double kRobotStart = 10000.0;

struct RobotBag {
  double seconds = 20.0;
  int beams = 360;
  double scan_rate = 10.0;      // [Hz]
  double odometry_rate = 50.0;  // [Hz]
  double revolution = 0.0;      // of the mirror [s]
  double noise = 0.01;          // [m]
  double range_max = 12.0;      // [m]
  double angle_min = -geometry::kPi;
  double angle_max = geometry::kPi - 2.0 * geometry::kPi / 360.0;
  bool moves = true;
  double wiggle = 0.0;  // to either side of the path, at 0.4 Hz [rad]
  simulation::Mounting mounting{0.1, 0.0, 0.3, 0.0, 0.0, 0.0};
  std::string laser = "laser";
  std::string odom = "odom";
  std::string base = "base_link";
  std::string scan_topic = "/scan";
  std::string tf_topic = "/tf";
  std::string static_topic = "/tf_static";  // none: the mounting stands in no message
  std::string odometry_topic;               // none: no messages of odometry
  bool odometry_on_tf = true;
  double odometry_delay = 0.0;  // of the recording behind the stamp [s]

  /// Edits of the messages, by the time since the start [s]. A transform, an odometry or a scan
  /// that is edited to have no frame is left out.
  std::function<void(sensor_msgs::LaserScan&, double)> scan;
  std::function<void(geometry_msgs::TransformStamped&, double)> transform;
  std::function<void(nav_msgs::Odometry&, double)> odometry;
  std::function<void(geometry_msgs::TransformStamped&)> mount;
  /// Writes a scan that was edited in another way than as a message on scan_topic.
  std::function<void(rosbag::Bag&, const ros::Time&, const sensor_msgs::LaserScan&)> write_scan;

  static geometry::Pose2 pathAt(double time) {
    const double phase = 2.0 * geometry::kPi * time / 22.0;
    const Eigen::Vector2d position(-0.3 + 1.8 * std::cos(phase), 0.1 + 1.1 * std::sin(phase));
    return {position, std::atan2(1.1 * std::cos(phase), -1.8 * std::sin(phase))};
  }
  /// T_map_base, so long after the start.
  geometry::Pose2 truth(double time) const {
    const double off = wiggle * std::sin(0.8 * geometry::kPi * time);
    return moves ? pathAt(time) * geometry::Pose2(0.0, 0.0, off) : pathAt(0.0);
  }
  /// T_odom_base as exact wheels have it.
  geometry::Pose2 wheels(double time) const { return geometry::between(truth(0.0), truth(time)); }
  static ros::Time stampOf(double time) { return ros::Time(kRobotStart + time); }

  /// Writes what is recorded from one time to another.
  void write(const std::string& path, double from = 0.0, double to = 1e9) const;

 private:
  simulation::ScannerProfile profile() const;
  void writeMounting(rosbag::Bag& bag, double time) const;
  void writeOdometry(rosbag::Bag& bag, double time) const;
  void writeScan(rosbag::Bag& bag, double time, const scan::Scan& scan) const;
};

inline simulation::ScannerProfile RobotBag::profile() const {
  simulation::ScannerProfile profile;
  profile.beams = beams;
  profile.angle_min = angle_min;
  profile.angle_max = angle_max;
  profile.range_max = range_max;
  profile.rate = scan_rate;
  profile.revolution = revolution;
  profile.resolution = 0.0;
  profile.noise.sigma = noise;
  return profile;
}

inline void RobotBag::writeMounting(rosbag::Bag& bag, double time) const {
  if (static_topic.empty()) return;
  tf2_msgs::TFMessage message;
  message.transforms = {bridge::toTransformMessage(base, laser, bridge::nanoseconds(stampOf(time)),
                                                   mounting.T_base_sensor())};
  if (mount) mount(message.transforms[0]);
  bag.write(static_topic, stampOf(time), message);
}

inline void RobotBag::writeOdometry(rosbag::Bag& bag, double time) const {
  const std::int64_t stamp = bridge::nanoseconds(stampOf(time));
  const ros::Time recorded = stampOf(time + odometry_delay);
  tf2_msgs::TFMessage message;
  message.transforms = {bridge::toTransformMessage(odom, base, stamp, wheels(time))};
  if (transform) transform(message.transforms[0], time);
  const bool is_there = !message.transforms[0].header.frame_id.empty();
  if (odometry_on_tf && is_there) bag.write(tf_topic, recorded, message);
  if (odometry_topic.empty()) return;
  nav_msgs::Odometry odometry_message;
  odometry_message.header.stamp = stampOf(time);
  odometry_message.header.frame_id = odom;
  odometry_message.child_frame_id = base;
  odometry_message.pose.pose = bridge::toPose(wheels(time));
  if (odometry) odometry(odometry_message, time);
  if (odometry_message.header.frame_id.empty()) return;
  bag.write(odometry_topic, recorded, odometry_message);
}

inline void RobotBag::writeScan(rosbag::Bag& bag, double time, const scan::Scan& swept) const {
  sensor_msgs::LaserScan message = bridge::toMessage(swept);
  message.header.frame_id = laser;
  message.scan_time = static_cast<float>(1.0 / scan_rate);
  if (scan) scan(message, time);
  const ros::Time recorded = stampOf(time + revolution);
  if (write_scan) return write_scan(bag, recorded, message);
  bag.write(scan_topic, recorded, message);
}

inline void RobotBag::write(const std::string& path, double from, double to) const {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const world::World world(config::Node::parse(kRobotWorld, "world of the robot"));
  simulation::Scanner scanner(profile(), mounting, 1);
  const auto poseAt = [this](std::int64_t stamp) {
    return truth(1e-9 * static_cast<double>(stamp) - kRobotStart);
  };
  if (from == 0.0) writeMounting(bag, 0.0);
  const int ticks = static_cast<int>(std::lround(seconds * 1000.0));
  const auto every = [](double rate) { return static_cast<int>(std::lround(1000.0 / rate)); };
  for (int tick = 0; tick <= ticks; ++tick) {
    const double time = 1e-3 * tick;
    const bool has_odometry = tick % every(odometry_rate) == 0;
    const bool has_scan = tick >= 100 && tick % every(scan_rate) == 0 && tick + 200 <= ticks;
    const auto swept =
        has_scan ? scanner.sweep(world, bridge::nanoseconds(stampOf(time)), poseAt) : scan::Scan();
    if (time < from || time >= to) continue;
    if (has_odometry) writeOdometry(bag, time);
    if (has_scan) writeScan(bag, time, swept);
  }
  bag.close();
}

}  // namespace sightline::test
