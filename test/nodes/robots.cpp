// Several robots of one sim_sensor.
#include <cmath>
#include <string>
#include <vector>

#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <sightline/RangeScan.h>
#include "nodes/comes_true.h"
#include "nodes/recorder.h"
#include "sightline/bridge/pose_conversion.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::Recorder;

double rangeAt(const sensor_msgs::LaserScan& scan, double angle) {
  const double beam = (angle - scan.angle_min) / scan.angle_increment;
  return scan.ranges.at(static_cast<std::size_t>(std::lround(beam)));
}

TEST(Robots, TopicsAndFramesBearTheirNames) {
  Recorder<sensor_msgs::LaserScan> of_ann("/ann/scan");
  Recorder<sensor_msgs::LaserScan> of_bob("/bob/scan");
  Recorder<nav_msgs::Odometry> odometry("/ann/odom");
  Recorder<nav_msgs::Odometry> truth("/bob/ground_truth");
  Recorder<RangeScan> range_scans("/ann/range_scan");
  Recorder<sensor_msgs::JointState> joints("/ann/joint_states");
  EXPECT_EQ(of_ann.next().header.frame_id, "ann/laser");
  EXPECT_EQ(of_bob.next().header.frame_id, "bob/laser");
  EXPECT_EQ(odometry.next().header.frame_id, "ann/odom");
  EXPECT_EQ(odometry.next().child_frame_id, "ann/base_link");
  EXPECT_EQ(truth.next().header.frame_id, "map");
  EXPECT_EQ(truth.next().child_frame_id, "bob/base_link");
  const RangeScan range_scan = range_scans.next();
  EXPECT_EQ(range_scan.header.frame_id, "ann/projection");
  EXPECT_EQ(range_scan.mount_frame, "ann/active_sensor");
  EXPECT_EQ(joints.next().name, std::vector<std::string>{"head_joint"});
}

TEST(Robots, LiveByOneClockAndSeeEachOther) {
  Recorder<nav_msgs::Odometry> truth_of_ann("/ann/ground_truth");
  Recorder<nav_msgs::Odometry> truth_of_bob("/bob/ground_truth");
  Recorder<sensor_msgs::LaserScan> scans("/ann/scan");
  const auto scan = scans.atLeast(5).back();
  const auto ann = truth_of_ann.atLeast(20).back();
  for (const auto& bob : truth_of_bob.atLeast(30)) {
    if (bob.header.stamp != ann.header.stamp) continue;
    const auto T_ann_bob =
        geometry::between(bridge::toPose2(ann.pose.pose), bridge::toPose2(bob.pose.pose));
    const double bearing = std::atan2(T_ann_bob.y(), T_ann_bob.x());
    EXPECT_NEAR(rangeAt(scan, bearing), T_ann_bob.translation().norm() - 0.2, 0.06);
    return;
  }
  ADD_FAILURE() << "no common stamps";
}

// Nobody else moves before the last case.
TEST(Robots, SeeThePersonWalk) {
  Recorder<sensor_msgs::LaserScan> scans("/ann/scan");
  const auto first = scans.next();
  const auto walked = [&](const sensor_msgs::LaserScan& scan) {
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      if (std::isfinite(scan.ranges[i]) && std::isinf(first.ranges[i])) return true;
    }
    return false;
  };
  for (int i = 0; i < 2000; ++i) {
    if (walked(scans.next())) return;
  }
  ADD_FAILURE() << "nothing new comes into view";
}

TEST(Turret, IsInTfAllTheTime) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  Recorder<sensor_msgs::LaserScan> scans("/bob/scan");
  ASSERT_TRUE(buffer.canTransform("bob/base_link", "bob/laser", ros::Time(0), ros::Duration(30.0)));
  const ros::Time start = scans.next().header.stamp + ros::Duration(0.1);
  const auto yawAt = [&](const ros::Time& time) {
    std::string error;
    EXPECT_TRUE(
        buffer.canTransform("bob/base_link", "bob/laser", time, ros::Duration(30.0), &error))
        << error;
    return bridge::toPose2(buffer.lookupTransform("bob/base_link", "bob/laser", time).transform);
  };
  const auto first = yawAt(start);
  EXPECT_NEAR(first.x(), 0.1, 1e-9);
  for (const double later : {0.013, 0.1, 0.5, 1.0}) {
    const auto turned = geometry::between(first, yawAt(start + ros::Duration(later)));
    EXPECT_NEAR(turned.theta(), geometry::radians(90.0) * later, 1e-6);
  }
}

TEST(Robots, CommandsReachTheOneTheyAreFor) {
  Recorder<nav_msgs::Odometry> truth_of_ann("/ann/ground_truth");
  Recorder<nav_msgs::Odometry> truth_of_bob("/bob/ground_truth");
  auto commands = ros::NodeHandle().advertise<geometry_msgs::Twist>("/bob/cmd_vel", 10);
  ASSERT_TRUE(test::comesTrue([&] { return commands.getNumSubscribers() > 0; }));
  geometry_msgs::Twist command;
  command.angular.z = 0.3;
  nav_msgs::Odometry bob = truth_of_bob.next();
  for (int i = 0; i < 3000 && bob.twist.twist.angular.z < 0.299; ++i) {
    commands.publish(command);
    bob = truth_of_bob.next();
  }
  EXPECT_NEAR(bob.twist.twist.angular.z, 0.3, 1e-9);
  EXPECT_EQ(truth_of_ann.next().twist.twist.angular.z, 0.0);
}

// A namespace of its own each time, as parameters stay with the master.
std::string endOfRobots(const std::string& robots) {
  static int number = 0;
  const std::string node = "/ended" + std::to_string(++number) + "/sim_sensor";
  test::runCommand("rosparam set " + node +
                   " \"{world: " SIGHTLINE_SOURCE_DIR "/config/worlds/edge.yaml, " + robots +
                   "}\"");
  const auto result = test::runProgram("sim_sensor", "__ns:=/ended" + std::to_string(number));
  EXPECT_EQ(result.status, 1) << result.output;
  return result.output;
}

TEST(Robots, NamesThatTwoHaveEndTheNode) {
  using testing::HasSubstr;
  EXPECT_THAT(endOfRobots("scanners: {a: {frame: a}, b: {frame: b}}"),
              HasSubstr("another has the topic 'scan' already"));
  EXPECT_THAT(endOfRobots("scanners: {a: {topic: a}, b: {topic: b}}"),
              HasSubstr("another has the frame 'laser' already"));
  EXPECT_THAT(endOfRobots("scanners: {a: {frame: base_link}}"),
              HasSubstr("another has the frame 'base_link' already"));
  EXPECT_THAT(
      endOfRobots("active_sensors: {a: {x: 0.1}, b: {scan: s, range_scan: r, head_command: h, "
                  "mount_frame: m, head_frame: n, frame: p}}"),
      HasSubstr("another has the joint 'head_joint' already"));
  EXPECT_THAT(endOfRobots("robots: {c: {start_pose: [1, 2]}}"),
              HasSubstr("expected a pose: [x, y, yaw]"));
  EXPECT_THAT(endOfRobots("movers: {d: {radius: 0.2}}"), HasSubstr("has to name a path file"));
}

}  // namespace
}  // namespace sightline
