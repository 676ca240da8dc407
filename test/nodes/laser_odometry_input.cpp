// What laser_odometry makes of scans, clocks and settings that are not as they should be.
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include "nodes/diagnostics.h"
#include "nodes/odometry_robot.h"
#include "nodes/refusal.h"

namespace sightline {
namespace {

using test::aside;
using test::comesTrue;
using test::refusalOf;
using testing::HasSubstr;
using Robot = test::OdometryRobot;

constexpr float kNoRange = std::numeric_limits<float>::quiet_NaN();

TEST(LaserOdometryNode, BadScansAreDroppedAndCounted) {
  const test::Diagnostics diagnostics;
  const std::string name = "laser_odometry: input /scan";
  Robot robot({"", aside()});
  robot.begin();
  EXPECT_TRUE(comesTrue([&] { return !diagnostics.value(name, "dropped").empty(); }));
  const int before = std::stoi(diagnostics.value(name, "dropped"));
  const auto good = robot.toMessage(robot.nextScan());
  auto no_beams = good;
  no_beams.ranges.clear();
  auto no_increment = good;
  no_increment.angle_increment = kNoRange;
  no_increment.angle_max = kNoRange;
  auto no_stamp = good;
  no_stamp.header.stamp = ros::Time();
  auto nowhere = good;
  nowhere.header.frame_id = "nobody_knows";
  auto no_frame = good;
  no_frame.header.frame_id.clear();
  for (const auto& bad : {no_beams, no_increment, no_stamp, nowhere, no_frame}) {
    robot.sendWithoutAnswer(bad);
  }
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT(robot.errorOf(robot.send(robot.nextScan())).translation().norm(), 0.04);
  }
  EXPECT_EQ(robot.answers(), 10U + Robot::kScansToBegin) << "to the good ones";
  EXPECT_TRUE(comesTrue([&] {
    return diagnostics.value(name, "dropped") == std::to_string(before + 5);
  })) << diagnostics.value(name, "dropped");
}

TEST(LaserOdometryNode, ScansWithHolesAndFewerBeamsAreMatchedAllTheSame) {
  Robot robot({"", aside()});
  robot.begin();
  for (int i = 0; i < 20; ++i) {
    auto scan = robot.nextScan();
    for (std::size_t beam = static_cast<std::size_t>(i); beam < scan.beams(); beam += 7) {
      scan.setKind(beam, i % 2 == 0 ? scan::ReturnKind::kInvalid : scan::ReturnKind::kNothing);
    }
    EXPECT_LT(robot.errorOf(robot.send(scan)).translation().norm(), 0.05);
  }
}

TEST(LaserOdometryNode, ResetStartsAnew) {
  Robot robot({"", aside()});
  robot.begin();
  for (int i = 0; i < 20; ++i) robot.send(robot.nextScan());
  std_srvs::Trigger call;
  ASSERT_TRUE(ros::service::call("laser_odometry/reset", call));
  EXPECT_TRUE(call.response.success);
  const auto answer = robot.begin();
  EXPECT_EQ(bridge::toPose2(answer.pose.pose).coordinates(), Eigen::Vector3d::Zero());
  EXPECT_EQ(answer.pose.covariance[0], 0.0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT(robot.errorOf(robot.send(robot.nextScan())).translation().norm(), 0.04);
  }
}

TEST(LaserOdometryNode, ClockSetBackDoesNotStopIt) {
  Robot later({"", aside()});
  Robot robot({"", aside()});
  robot.begin();
  robot.send(robot.nextScan());
  later.begin();
  const auto stamp = later.send(later.nextScan()).header.stamp;
  EXPECT_NE(stamp, ros::Time());
}

TEST(LaserOdometryParameters, OutOfRangeOrOfTheWrongTypeEndTheNode) {
  EXPECT_THAT(refusalOf("laser_odometry", "_odometry/carrier/max_speed:=-1"),
              HasSubstr("odometry.carrier.max_speed: -1 is outside"));
  EXPECT_THAT(refusalOf("laser_odometry", "_odometry/method:=guess"),
              HasSubstr("odometry.method: 'guess' is none of"));
  EXPECT_THAT(refusalOf("laser_odometry", "_publish_tf:=perhaps"),
              HasSubstr("publish_tf: expected true or false"));
}

}  // namespace
}  // namespace sightline
