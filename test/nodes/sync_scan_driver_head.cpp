// The head of an emulated device, commanded through the driver.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "nodes/driver_test.h"
#include "nodes/recorder.h"
#include "sightline/HeadCommand.h"
#include "sightline/RangeScan.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline {
namespace {

using test::comesTrue;
using test::Recorder;

class HeadCommands : public test::DriverTest {
 protected:
  void SetUp() override {
    start("head");
    joints_.atLeast(1);
    ASSERT_TRUE(comesTrue([this] { return publisher_.getNumSubscribers() > 0; }));
  }
  void send(std::uint8_t mode, double position, double rate, const std::string& joint = "") {
    HeadCommand command;
    command.joint = joint;
    command.mode = mode;
    command.position = position;
    command.rate = rate;
    publisher_.publish(command);
  }
  double angle() const { return joints_.next().position.at(0); }
  // For a while by the stamps.
  bool stands() const {
    const auto first = joints_.next();
    auto last = first;
    while (!HasFailure() && last.header.stamp < first.header.stamp + ros::Duration(0.3)) {
      last = joints_.next();
    }
    return last.position == first.position;
  }
  void expectRefused(const std::string& reason) {
    diagnostics_.expectValue("head/sync_scan_driver: input /head/head_command", "last reason",
                             reason);
  }

  Recorder<sensor_msgs::JointState> joints_{"/head/joint_states"};
  ros::Publisher publisher_ = ros::NodeHandle().advertise<HeadCommand>("/head/head_command", 10);
};

TEST_F(HeadCommands, TurnTheHead) {
  send(HeadCommand::POSITION, 0.7, 0.0, "head_joint");
  EXPECT_TRUE(comesTrue([&] { return std::abs(angle() - 0.7) < 0.0035; }));
  send(HeadCommand::RATE, 0.0, -0.2);
  EXPECT_TRUE(comesTrue([&] { return angle() < 0.6; }));
  send(HeadCommand::STOP, 0.0, 0.0);
  EXPECT_TRUE(comesTrue([&] { return stands(); }));
  EXPECT_GT(angle(), -1.0) << "it halts at its limits anyway";
}

// Every sample is known to tf, to what a servo leaves the straight line by between two of those
// that are told, and all of a scan come at once.
TEST_F(HeadCommands, TurnTheHeadInTf) {
  tf2_ros::Buffer buffer(ros::Duration(60.0));
  tf2_ros::TransformListener listener(buffer);
  Recorder<tf2_msgs::TFMessage> transforms("/tf");
  Recorder<RangeScan> scans("/head/range_scan");
  ASSERT_TRUE(
      buffer.canTransform("active_sensor", "projection", ros::Time(0), ros::Duration(30.0)));
  const RangeScan first = scans.next();
  send(HeadCommand::RATE, 0.0, 0.8);
  EXPECT_TRUE(comesTrue([&] { return angle() > 0.6; }));
  send(HeadCommand::STOP, 0.0, 0.0);
  std::size_t turning = 0;
  for (const RangeScan& scan : scans.all()) {
    if (scan.header.stamp <= first.header.stamp) continue;
    turning += scan.head_angles.front() == scan.head_angles.back() ? 0 : 1;
    for (std::size_t i = 0; i < scan.head_angles.size(); ++i) {
      const ros::Time time =
          scan.header.stamp + ros::Duration(static_cast<double>(i) * scan.time_increment);
      // The last sample, as float seconds have it, may be a hair after the newest transform.
      ASSERT_TRUE(buffer.canTransform("active_sensor", "head", time, ros::Duration(10.0)));
      const auto pose =
          bridge::toPose2(buffer.lookupTransform("active_sensor", "head", time).transform);
      ASSERT_NEAR(pose.theta(), scan.head_angles[i], 6e-4);
    }
  }
  EXPECT_GE(turning, 5U);
  std::size_t most = 0;
  for (const auto& message : transforms.all()) most = std::max(most, message.transforms.size());
  EXPECT_GE(most, 10U);
  const auto T_head_projection =
      bridge::toPose2(buffer.lookupTransform("head", "projection", ros::Time(0)).transform);
  EXPECT_NEAR(T_head_projection.x(), 0.05, 1e-12);
  EXPECT_NEAR(T_head_projection.y(), -0.03, 1e-12);
}

TEST_F(HeadCommands, AreRefusedByNameAndTheHeadStaysWhereItIs) {
  send(HeadCommand::POSITION, 2.0, 0.0);
  expectRefused("a position of 2");
  send(HeadCommand::POSITION, std::numeric_limits<double>::quiet_NaN(), 0.0);
  expectRefused("a position that is not finite");
  send(HeadCommand::RATE, 0.0, 100.0);
  expectRefused("a rate of 100");
  send(HeadCommand::POSITION, 0.5, -1.0);
  expectRefused("a rate below 0");
  send(HeadCommand::POSITION, 0.5, 0.0, "elbow");  // is for another head
  send(7, 0.0, 0.0);
  expectRefused("an unknown mode 7");
  EXPECT_EQ(angle(), 0.0);
}

}  // namespace
}  // namespace sightline
