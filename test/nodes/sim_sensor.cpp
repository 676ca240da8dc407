#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "nodes/comes_true.h"
#include "nodes/recorder.h"
#include "nodes/refusal.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline {
namespace {

using test::comesTrue;
using test::Recorder;
using test::refusalOf;

template <class Message>
std::vector<double> intervals(const std::vector<Message>& messages) {
  std::vector<double> result;
  for (std::size_t i = 1; i < messages.size(); ++i) {
    result.push_back((messages[i].header.stamp - messages[i - 1].header.stamp).toSec());
  }
  return result;
}

TEST(SimSensorNode, ScansComeAtTheRateOfTheirProfileInTheirFrame) {
  Recorder<sensor_msgs::LaserScan> front("/one/scan");
  Recorder<sensor_msgs::LaserScan> rear("/one/rear_scan");
  const auto scans = front.atLeast(40);
  ASSERT_FALSE(scans.empty());
  EXPECT_THAT(intervals(scans), testing::Each(testing::DoubleNear(0.025, 2e-9)));
  EXPECT_EQ(scans[0].header.frame_id, "one/laser");
  EXPECT_EQ(scans[0].ranges.size(), 1081u);
  EXPECT_EQ(scans[0].intensities.size(), 1081u);
  EXPECT_FLOAT_EQ(scans[0].time_increment, 0.025f / 1440.0f);
  const auto slow = rear.atLeast(3);
  ASSERT_FALSE(slow.empty());
  EXPECT_THAT(intervals(slow), testing::Each(testing::DoubleNear(1.0 / 3.0, 2e-9)));
  EXPECT_EQ(slow[0].header.frame_id, "one/rear_laser");
  EXPECT_EQ(slow[0].ranges.size(), 361u);
}

TEST(SimSensorNode, OdometryAndTruthShareStampsAndBodyFrame) {
  Recorder<nav_msgs::Odometry> odometry("/two/odom");
  Recorder<nav_msgs::Odometry> truth("/two/ground_truth");
  const auto measured = odometry.atLeast(20);
  const auto real = truth.atLeast(20);
  ASSERT_FALSE(measured.empty() || real.empty());
  EXPECT_THAT(intervals(measured), testing::Each(testing::DoubleNear(0.05, 2e-9)));
  EXPECT_EQ(measured[0].header.frame_id, "two/odom");
  EXPECT_EQ(measured[0].child_frame_id, "two/base_link");
  EXPECT_EQ(real[0].header.frame_id, "map");
  EXPECT_EQ(real[0].child_frame_id, "two/base_link");
  std::size_t common = 0;
  for (const auto& a : measured) {
    for (const auto& b : real) common += a.header.stamp == b.header.stamp ? 1u : 0u;
  }
  EXPECT_GE(common, 15u);
}

TEST(SimSensorNode, TransformsLeadFromEachOdometryToEachLaser) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  Recorder<sensor_msgs::LaserScan> scans("/two/scan");
  // The listener knows nothing of the time before it was there.
  buffer.canTransform("two/odom", "two/laser", ros::Time(0), ros::Duration(60.0));
  buffer.canTransform("one/odom", "one/rear_laser", ros::Time(0), ros::Duration(60.0));
  const auto stamp = scans.next().header.stamp + ros::Duration(0.1);
  std::string error;
  EXPECT_TRUE(buffer.canTransform("two/odom", "two/laser", stamp, ros::Duration(5.0), &error))
      << error;
  EXPECT_TRUE(buffer.canTransform("one/odom", "one/rear_laser", stamp, ros::Duration(5.0), &error))
      << error;
  EXPECT_FALSE(buffer.canTransform("one/odom", "two/odom", ros::Time(0)));
  const auto mounting = bridge::toIsometry(
      buffer.lookupTransform("one/base_link", "one/rear_laser", ros::Time(0)).transform);
  EXPECT_LT(mounting.linear()(2, 2), 0.0) << "it hangs upside down";
  EXPECT_NEAR(mounting.translation().x(), -0.2, 1e-9);
}

TEST(SimSensorNode, PathDrivesTheSecondRobot) {
  Recorder<nav_msgs::Odometry> truth("/two/ground_truth");
  const auto before = bridge::toPose2(truth.next().pose.pose);
  for (int i = 0; i < 3000; ++i) {
    const auto now = truth.next();
    if ((bridge::toPose2(now.pose.pose).translation() - before.translation()).norm() > 0.3) {
      EXPECT_GT(now.twist.twist.linear.x, 0.0);
      return;
    }
  }
  FAIL() << "it does not move";
}

TEST(SimSensorNode, CommandsDriveTheFirstRobotUntilTheyCease) {
  Recorder<nav_msgs::Odometry> truth("/one/ground_truth");
  Recorder<nav_msgs::Odometry> odometry("/one/odom");
  auto commands = ros::NodeHandle().advertise<geometry_msgs::Twist>("/one/cmd_vel", 10);
  ASSERT_TRUE(comesTrue([&] { return commands.getNumSubscribers() > 0; }));
  geometry_msgs::Twist command;
  command.linear.x = 0.2;
  command.angular.z = -0.1;
  nav_msgs::Odometry now = truth.next();
  for (int i = 0; i < 3000 && now.twist.twist.linear.x < 0.199; ++i) {
    commands.publish(command);
    now = truth.next();
  }
  EXPECT_NEAR(now.twist.twist.linear.x, 0.2, 1e-9);
  EXPECT_NEAR(now.twist.twist.angular.z, -0.1, 1e-9);
  EXPECT_GT(odometry.next().twist.twist.linear.x, 0.1);
  EXPECT_GT(odometry.next().pose.covariance[0], 0.0);
  const ros::Time last = now.header.stamp;
  // One more may be under way; then 0.5 s to the time-out, and 0.4 s at 0.5 m/s² to stop.
  while (now.header.stamp < last + ros::Duration(2.0) && ros::ok()) now = truth.next();
  EXPECT_EQ(now.twist.twist.linear.x, 0.0);
  EXPECT_EQ(now.twist.twist.angular.z, 0.0);
  EXPECT_EQ(odometry.next().twist.twist.linear.x, 0.0);
}

TEST(SimSensorNode, CommandThatIsNotANumberIsDropped) {
  Recorder<nav_msgs::Odometry> truth("/one/ground_truth");
  auto commands = ros::NodeHandle().advertise<geometry_msgs::Twist>("/one/cmd_vel", 10);
  ASSERT_TRUE(comesTrue([&] { return commands.getNumSubscribers() > 0; }));
  geometry_msgs::Twist command;
  command.linear.x = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 20; ++i) {
    commands.publish(command);
    const auto now = truth.next();
    EXPECT_EQ(now.twist.twist.linear.x, 0.0);
    EXPECT_TRUE(bridge::toPose2(now.pose.pose).isFinite());
  }
}

std::string worldWith(const std::string& text) {
  const std::string path = testing::TempDir() + "sim_sensor_world.yaml";
  std::ofstream(path) << text;
  return path;
}

TEST(SimSensorNode, BadFilesEndItWithFileLineAndKey) {
  using testing::HasSubstr;
  const std::string world = worldWith("materials: {}\ndiscs:\n  - {centre: [0, 0], radius: -1}\n");
  EXPECT_THAT(refusalOf("sim_sensor", "_world:=" + world),
              HasSubstr(world + ":3: discs[0].radius: -1 is outside"));
  EXPECT_THAT(refusalOf("sim_sensor", ""), HasSubstr("world: has to name a world file"));
  EXPECT_THAT(refusalOf("sim_sensor", "_world:=/nowhere.yaml"),
              HasSubstr("/nowhere.yaml: no such file"));
  const std::string empty = worldWith("{}");
  EXPECT_THAT(refusalOf("sim_sensor", "_world:=" + empty + " _odometry_rate:=-1"),
              HasSubstr("odometry_rate: -1 is outside"));
  EXPECT_THAT(refusalOf("sim_sensor", "_world:=" + empty + " _path:=" + world),
              HasSubstr(world + ":1: missing key 'waypoints'"));
}

}  // namespace
}  // namespace sightline
