#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "nodes/connections.h"
#include "nodes/recorder.h"
#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/odometry_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/simulation.h"

namespace sightline::test {

/// A room of six walls, no two of the same length.
inline world::World sixWalls() {
  world::World world;
  world.add(world::WorldPlate{{}, 0.0, 0});
  const std::vector<Eigen::Vector2d> corners{{-4.0, -3.0}, {5.0, -3.0}, {5.0, 1.0},
                                             {3.5, 1.0},   {3.5, 3.0},  {-4.0, 3.0}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    world::WorldSegment segment;
    segment.segment = {corners[i], corners[(i + 1) % corners.size()]};
    world.add(segment);
  }
  return world;
}

inline geometry_msgs::TransformStamped mountingMessage(const std::string& base,
                                                       const std::string& frame,
                                                       const simulation::Mounting& mounting) {
  return bridge::toTransformMessage(base, frame, 0, mounting.T_base_sensor());
}

/// A scanner that sits aside, turned.
inline simulation::Mounting aside() {
  simulation::Mounting mounting;
  mounting.x = 0.2;
  mounting.y = 0.1;
  mounting.z = 0.4;
  mounting.yaw = 0.3;
  return mounting;
}

/// A robot on a curve through a room, and the node that is told of its scans. Each test goes on
/// with a clock of its own, days after the one before, which starts the odometry anew.
class OdometryRobot {
 public:
  static constexpr int kScansToBegin = 3;

  struct Kind {
    std::string prefix;  // of topics and frames
    simulation::Mounting mounting;
    std::string process = "/" + prefix + "laser_odometry";  // the node's, or its manager's
    bool is_person = false;
    bool has_transform = true;
  };

  explicit OdometryRobot(const Kind& kind)
      : kind_(kind),
        simulation_(sixWalls(), {}, geometry::Pose2(-2.0, -1.0, 0.2), 3),
        scans_(node_.advertise<sensor_msgs::LaserScan>(kind.prefix + "scan", 100)),
        wheels_(node_.advertise<nav_msgs::Odometry>(kind.prefix + "odom", 100)),
        imu_(node_.advertise<sensor_msgs::Imu>(kind.prefix + "imu", 1000)),
        answers_(kind.prefix + "laser_odom") {
    simulation::ScannerProfile profile;
    profile.beams = 361;
    profile.angle_min = geometry::radians(-120.0);
    profile.angle_max = geometry::radians(120.0);
    profile.rate = 10.0;
    if (kind.is_person) simulation_.carrier().walk({});
    simulation_.carrier().addScanner(profile, kind.mounting);
    static ros::Time next_start(1000, 0);
    start_ = next_start;
    next_start += ros::Duration(100000.0);
    if (kind.has_transform) {
      static tf2_ros::StaticTransformBroadcaster broadcaster;
      broadcaster.sendTransform(
          mountingMessage(kind.prefix + "base_link", kind.prefix + "laser", kind.mounting));
    }
    const std::string& test = ros::this_node::getName();
    for (const auto* publisher : {&scans_, &wheels_, &imu_}) {
      waitForConnection(test, publisher->getTopic(), kind.process);
    }
    if (kind.has_transform) waitForConnection(test, "/tf_static", kind.process);
    waitForConnection(kind.process, "/" + kind.prefix + "laser_odom", test);
  }

  /// Drives until the next scan.
  scan::Scan nextScan() {
    while (true) {
      simulation_.carrier().command({0.5, 0.25});
      const simulation::Outputs outputs = simulation_.step();
      if (sends_wheels) wheels_.publish(wheelMessage());
      if (sends_imu) imu_.publish(imuMessage(outputs.motions.front()));
      if (!outputs.sweeps.empty()) return outputs.sweeps.front().scan;
    }
  }

  sensor_msgs::LaserScan toMessage(scan::Scan scan) const {
    scan.stamp += bridge::nanoseconds(start_);
    scan.frame = kind_.prefix + "laser";
    return bridge::toMessage(scan);
  }

  /// What the node says to a scan; the truth of it goes to `truth`.
  nav_msgs::Odometry send(const scan::Scan& scan) {
    truth = truthAt(scan.stamp);
    scans_.publish(toMessage(scan));
    const auto all = answers_.atLeast(++answered_);
    return all.empty() ? nav_msgs::Odometry() : all.back();
  }

  void sendWithoutAnswer(const sensor_msgs::LaserScan& message) { scans_.publish(message); }

  /// Starts the odometry anew, because the clock is one of its own: that is believed from its third
  /// scan on. Returns the answer to the first one.
  nav_msgs::Odometry begin() {
    for (int i = 0; i < kScansToBegin; ++i) {
      const auto scan = nextScan();
      truth = truthAt(scan.stamp);
      if (i == 0) truth_first_ = truth;
      scans_.publish(toMessage(scan));
    }
    const std::size_t before = answered_;
    answered_ += kScansToBegin;
    const auto all = answers_.atLeast(answered_);
    const auto answer = all.size() > before ? all[before] : nav_msgs::Odometry();
    first_ = bridge::toPose2(answer.pose.pose);
    truth = truth_first_;
    return answer;
  }

  /// Error of the pose since begin().
  geometry::Pose2 errorOf(const nav_msgs::Odometry& answer) const {
    return geometry::between(geometry::between(truth_first_, truth),
                             geometry::between(first_, bridge::toPose2(answer.pose.pose)));
  }

  geometry::Pose2 truthAt(std::int64_t stamp) const {
    return simulation_.carrier().T_map_base(stamp);
  }
  std::size_t answers() const { return answers_.count(); }

  geometry::Pose2 truth;
  bool sends_wheels = false;
  bool sends_imu = false;

 private:
  ros::Time now() const { return bridge::timeOf(bridge::nanoseconds(start_) + simulation_.time()); }

  nav_msgs::Odometry wheelMessage() const {
    return bridge::toOdometryMessage(
        {bridge::nanoseconds(now()), kind_.prefix + "odom", kind_.prefix + "base_link"},
        {truthAt(simulation_.time()), Eigen::Matrix3d::Zero()}, {});
  }

  sensor_msgs::Imu imuMessage(const simulation::ReportedMotion& motion) const {
    return bridge::toImuMessage(bridge::nanoseconds(now()), kind_.prefix + "base_link",
                                motion.attitude, motion.turn_rate);
  }

  Kind kind_;
  ros::NodeHandle node_;
  simulation::Simulation simulation_;
  ros::Publisher scans_;
  ros::Publisher wheels_;
  ros::Publisher imu_;
  Recorder<nav_msgs::Odometry> answers_;
  ros::Time start_;
  std::size_t answered_ = 0;
  geometry::Pose2 first_;
  geometry::Pose2 truth_first_;
};

}  // namespace sightline::test
