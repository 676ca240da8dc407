// What laser_odometry says of robots that drive and of a person who walks.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>
#include <Eigen/Eigenvalues>

#include "nodes/diagnostics.h"
#include "nodes/odometry_robot.h"
#include "nodes/recorder.h"

namespace sightline {
namespace {

using geometry::Pose2;
using test::aside;
using test::comesTrue;
using test::Recorder;
using Robot = test::OdometryRobot;

TEST(LaserOdometryNode, FollowsTheRobotWithOneAnswerToAScan) {
  Robot robot({"", aside()});
  robot.begin();
  for (int i = 0; i < 60; ++i) {
    const auto scan = robot.nextScan();
    const auto answer = robot.send(scan);
    EXPECT_EQ(answer.header.stamp, robot.toMessage(scan).header.stamp);
    EXPECT_EQ(answer.header.frame_id, "odom");
    EXPECT_EQ(answer.child_frame_id, "base_link");
    const Pose2 error = robot.errorOf(answer);
    EXPECT_LT(error.translation().norm(), 0.04);
    EXPECT_LT(std::abs(error.theta()), 0.015);
    if (i < 20) continue;  // it has come to speed by then
    EXPECT_NEAR(answer.twist.twist.linear.x, 0.5, 0.2);
    EXPECT_NEAR(answer.twist.twist.angular.z, 0.25, 0.2);
    for (const auto& covariance : {answer.pose.covariance, answer.twist.covariance}) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
          bridge::toCovariance3(covariance));
      EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
    }
  }
  EXPECT_EQ(robot.answers(), 60U + Robot::kScansToBegin);
}

TEST(LaserOdometryNode, AScannerOnItsHeadSeesTheSameAndOwnsTheTransform) {
  auto mounting = aside();
  mounting.roll = geometry::kPi;
  Recorder<tf2_msgs::TFMessage> transforms("/tf");
  Robot robot({"hanging/", mounting});
  robot.begin();
  nav_msgs::Odometry answer;
  for (int i = 0; i < 40; ++i) {
    answer = robot.send(robot.nextScan());
    EXPECT_LT(robot.errorOf(answer).translation().norm(), 0.04);
    EXPECT_LT(std::abs(robot.errorOf(answer).theta()), 0.015);
  }
  EXPECT_LT(0.2, bridge::toPose2(answer.pose.pose).theta()) << "it went to the left";
  for (const auto& message : transforms.atLeast(41)) {
    const auto& transform = message.transforms.front();
    ASSERT_EQ(transform.header.frame_id, "hanging/odom") << "nobody else publishes one";
    EXPECT_EQ(transform.child_frame_id, "hanging/base_link");
    if (transform.header.stamp != answer.header.stamp) continue;
    EXPECT_EQ(transform.transform.translation.x, answer.pose.pose.position.x);
    EXPECT_EQ(transform.transform.rotation.z, answer.pose.pose.orientation.z);
  }
}

TEST(LaserOdometryNode, WheelsBringItThroughScansThatSayNothing) {
  Robot robot({"", aside()});
  robot.sends_wheels = true;
  std_srvs::Trigger call;
  ASSERT_TRUE(ros::service::call("laser_odometry/reset", call));
  robot.nextScan();
  const test::Diagnostics diagnostics;
  EXPECT_TRUE(comesTrue([&] {
    const std::string used = diagnostics.value("laser_odometry: input /odom", "used");
    return !used.empty() && used != "0";
  })) << "the node does not know of the wheels before the first scan";
  const auto begun = robot.begin();
  EXPECT_LT(geometry::between(robot.truth, bridge::toPose2(begun.pose.pose)).translation().norm(),
            1e-3)
      << "it begins where the wheels are";
  for (int i = 0; i < 40; ++i) {
    auto scan = robot.nextScan();
    for (std::size_t beam = 0; beam < scan.beams() && i > 10 && i < 20; ++beam) {
      scan.setKind(beam, scan::ReturnKind::kNothing);
    }
    const auto answer = robot.send(scan);
    EXPECT_LT(robot.errorOf(answer).translation().norm(), 0.05) << i;
  }
}

TEST(WornLaserOdometry, FollowsAPersonAndLeavesOutTheFloor) {
  const test::Diagnostics diagnostics;
  simulation::Mounting mounting;
  mounting.z = 1.2;
  Robot::Kind person{"worn/", mounting};
  person.is_person = true;
  person.has_transform = false;
  Robot robot(person);
  robot.sends_imu = true;
  robot.begin();
  for (int i = 0; i < 60; ++i) {
    const auto answer = robot.send(robot.nextScan());
    EXPECT_LT(robot.errorOf(answer).translation().norm(), 0.08);
    EXPECT_LT(std::abs(robot.errorOf(answer).theta()), 0.02);
  }
  diagnostics.expectValue("worn/laser_odometry: odometry", "mounting",
                          "none: the scanner is the base");
}

TEST(NodeletOfLaserOdometry, AnswersAsTheNodeDoes) {
  Robot::Kind kind{"nodelets/", {}, "/nodelets/manager"};
  kind.has_transform = false;
  Robot robot(kind);
  robot.begin();
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT(robot.errorOf(robot.send(robot.nextScan())).translation().norm(), 0.04);
  }
}

}  // namespace
}  // namespace sightline
