// What the live room tracker makes of clocks that are set, of scanners with equal stamps, and of
// rooms that are replaced.
#include <set>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include "nodes/diagnostics.h"
#include "nodes/living_room_robot.h"
#include "nodes/recorder.h"
#include "sightline/LoadRooms.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline {
namespace {

using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;
using test::comesTrue;
using test::Recorder;

class OtherRobots : public test::LivingRoomRobot {
 protected:
  // A scan now by the robot's clock, and the odometry of the scan before: it comes late.
  void scanWithLateOdometry() {
    const ros::Time now = ros::Time::now() + ros::Duration(offset_);
    scan_publisher_.publish(look(now));
    if (!late_.isZero()) sendOdometry(late_);
    late_ = now;
  }
  double offset_ = 0.0;
  ros::Time late_;
};

TEST_F(OtherRobots, AnswerSoonAfterTheClockWasSetBackWhileOdometryIsLate) {
  Recorder<PoseMessage> poses("pose");
  const test::Diagnostics diagnostics;
  EXPECT_TRUE(comesTrue([&] { return poses.count() >= 5; }, [this] { scanWithLateOdometry(); }));
  for (const double step : {-20.0, -3600.0}) {
    offset_ += step;
    const ros::Time end = ros::Time::now() + ros::Duration(offset_ + 10.0);
    int scans = 0;
    const auto isAnswered = [&] {
      const auto all = poses.all();
      return all.back().header.stamp < end;
    };
    EXPECT_TRUE(comesTrue(isAnswered, [&] {
      scanWithLateOdometry();
      ++scans;
    }));
    EXPECT_LE(scans, 20) << "more than a second of scans";
    const auto pose = poses.all().back();
    EXPECT_NEAR(pose.pose.pose.position.x, truth_.x(), 0.03);
  }
  diagnostics.expectValue("room_tracker: input /scan", "the clock was set", "");
}

TEST_F(OtherRobots, OneTransformForEachStampOfTwoScanners) {
  const ros::Publisher second = node_.advertise<sensor_msgs::LaserScan>("/scan2", 10);
  for (const char* topic : {"/scan", "/tf", "/tf_static", "/scan2"}) {
    test::waitForConnection(ros::this_node::getName(), topic, "/two/room_tracker");
  }
  Recorder<PoseMessage> poses("/two/pose");
  Recorder<tf2_msgs::TFMessage> transforms("/tf");
  EXPECT_TRUE(comesTrue([&] { return poses.count() >= 20; },
                        [&] {
                          const ros::Time now = ros::Time::now();
                          sendOdometry(now);
                          scan_publisher_.publish(look(now));
                          second.publish(look(now));
                        }));
  std::set<ros::Time> stamps;
  for (const auto& message : transforms.all()) {
    for (const auto& transform : message.transforms) {
      if (transform.header.frame_id != "two/map") continue;
      EXPECT_EQ(transform.child_frame_id, "odom");
      EXPECT_TRUE(stamps.insert(transform.header.stamp).second) << "twice the same stamp";
    }
  }
  EXPECT_GE(stamps.size(), 10U);
  // Between scans, too.
  const std::size_t before = transforms.count();
  EXPECT_TRUE(comesTrue([&] { return transforms.count() >= before + 10; }));
}

TEST_F(OtherRobots, RoomsCanBeReplaced) {
  Recorder<PoseMessage> poses("pose");
  Recorder<nav_msgs::OccupancyGrid> maps("map");
  scanUntil(poses, 2);
  EXPECT_TRUE(comesTrue([&] { return maps.count() >= 1; }));
  LoadRooms service;
  service.request.path = SIGHTLINE_SOURCE_DIR "/config/rooms/none.yaml";
  ASSERT_TRUE(ros::service::call("/room_tracker/load_rooms", service));
  EXPECT_FALSE(service.response.success);
  EXPECT_NE(service.response.message.find("none.yaml"), std::string::npos);
  service.request.path = SIGHTLINE_SOURCE_DIR "/config/rooms/living_room.yaml";
  ASSERT_TRUE(ros::service::call("/room_tracker/load_rooms", service));
  EXPECT_TRUE(service.response.success) << service.response.message;
  EXPECT_TRUE(comesTrue([&] { return maps.count() >= 2; }));
  const auto pose = scanUntil(poses, poses.count() + 3);
  EXPECT_NEAR(pose.pose.pose.position.x, truth_.x(), 0.03);
}

}  // namespace
}  // namespace sightline
