#pragma once

#include <string>

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/RangeScan.h"
#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/odometry_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/range_scan_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/simulation.h"

namespace sightline::test {

/// A drive through a world, written into a bag as its messages would come: `scan` of a fixed
/// scanner, `range_scan` of a sensor on a head that turns to and fro, `imu`, `odom` and tf.
class RecordedDrive {
 public:
  static constexpr std::int64_t kStart = 1'000'000'000'000;  ///< [ns]

  RecordedDrive(const std::string& bag, const std::string& world, const std::string& path,
                const geometry::Pose2& start)
      : bag_(bag, rosbag::bagmode::Write),
        simulation_(world::World::readFile(world), 1),
        carrier_(simulation_.addRobot({}, start)) {
    carrier_.follow(simulation::Path::readFile(path));
    const simulation::Mounting scanner{0.1, 0.0, 0.4};
    const simulation::Mounting sensor{0.2, 0.05, 0.4};
    carrier_.addScanner({}, scanner);
    carrier_.addActiveSensor({}, sensor);
    const auto origin = carrier_.calibration(0).parameters.origin.position();
    tf2_msgs::TFMessage mountings;
    mountings.transforms = {transform("base_link", "laser", 0, {0.1, 0.0, 0.0}),
                            transform("base_link", "active_sensor", 0, {0.2, 0.05, 0.0}),
                            transform("head", "projection", 0, {origin.x(), origin.y(), 0.0})};
    write("/tf_static", mountings);
  }

  void drive(double seconds) {
    while (simulation_.time() < static_cast<std::int64_t>(1e9 * seconds)) step();
    bag_.close();
  }

 private:
  static geometry_msgs::TransformStamped transform(const std::string& parent,
                                                   const std::string& child, std::int64_t stamp,
                                                   const geometry::Pose2& pose) {
    return bridge::toTransformMessage(parent, child, kStart + stamp, pose);
  }

  template <class Message>
  void write(const std::string& topic, const Message& message) {
    bag_.write(topic, bridge::timeOf(kStart + simulation_.time()), message);
  }

  void writeTransform(const std::string& parent, const std::string& child, std::int64_t stamp,
                      const geometry::Pose2& pose) {
    tf2_msgs::TFMessage message;
    message.transforms = {transform(parent, child, stamp, pose)};
    write("/tf", message);
  }

  void step() {
    if (simulation_.time() % 500'000'000 == 0) turnHead();
    simulation::Outputs outputs = simulation_.step();
    for (const auto& state : outputs.states) {
      write("/odom", bridge::toOdometryMessage({kStart + state.stamp, "odom", "base_link"},
                                               state.pose, state.twist));
      writeTransform("odom", "base_link", state.stamp, state.pose.mean);
    }
    for (const auto& motion : outputs.motions) {
      write("/imu", bridge::toImuMessage(kStart + motion.stamp, "base_link", motion.attitude,
                                         motion.turn_rate));
    }
    for (const auto& head : outputs.heads) {
      writeTransform("active_sensor", "head", head.stamp, {0.0, 0.0, head.angle});
    }
    for (auto& sweep : outputs.sweeps) writeScan(sweep.scan);
    for (auto& finished : outputs.range_scans) writeRangeScan(finished.range_scan);
  }

  void turnHead() {
    to_left_ = !to_left_;
    carrier_.commandHead(0, {motion::HeadCommand::Mode::kPosition, to_left_ ? 0.6 : -0.6, 2.0});
  }

  void writeScan(scan::Scan& scan) {
    scan.stamp += kStart;
    scan.frame = "laser";
    write("/scan", bridge::toMessage(scan));
  }

  void writeRangeScan(motion::RangeScan& range_scan) {
    range_scan.scan.stamp += kStart;
    range_scan.scan.frame = "projection";
    range_scan.head.mount_frame = "active_sensor";
    write("/range_scan", bridge::toMessage(range_scan));
  }

  rosbag::Bag bag_;
  simulation::Simulation simulation_;
  simulation::Carrier& carrier_;
  bool to_left_ = false;
};

}  // namespace sightline::test
