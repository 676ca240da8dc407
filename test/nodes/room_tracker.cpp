// What room_tracker says of a robot in a room that it knows.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include "nodes/living_room_robot.h"
#include "nodes/recorder.h"
#include "nodes/refusal.h"
#include "sightline/InflateUncertainty.h"
#include "sightline/SetRoom.h"
#include "sightline/TrackerStatus.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline {
namespace {

using geometry::Pose2;
using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;
using test::comesTrue;
using test::Recorder;

using RoomTrackerNode = test::LivingRoomRobot;

// The messages that hold at a stamp.
template <class Message>
std::vector<Message> messagesAt(const ros::Time& stamp, const Recorder<Message>& recorder) {
  std::vector<Message> found;
  for (const Message& message : recorder.all()) {
    if (message.header.stamp == stamp) found.push_back(message);
  }
  return found;
}

TEST_F(RoomTrackerNode, TracksWithTheStampOfTheScan) {
  Recorder<PoseMessage> poses("pose");
  Recorder<TrackerStatus> statuses("tracker_status");
  scanUntil(poses, 5);
  const ros::Time stamp = scan();
  // The node answers in order: what is said of this scan has come once something is said of a later
  // one.
  const auto isAfter = [&](const auto& messages) {
    return !messages.empty() && messages.back().header.stamp > stamp;
  };
  EXPECT_TRUE(comesTrue([&] { return isAfter(poses.all()) && isAfter(statuses.all()); },
                        [this] { scan(); }));
  ASSERT_EQ(messagesAt(stamp, poses).size(), 1U) << "one output for one scan";
  ASSERT_EQ(messagesAt(stamp, statuses).size(), 1U);
  const PoseMessage pose = messagesAt(stamp, poses)[0];
  EXPECT_EQ(pose.header.frame_id, "map");
  const Pose2 found = bridge::toPose2(pose.pose.pose);
  EXPECT_NEAR(found.x(), truth_.x(), 0.02);
  EXPECT_NEAR(found.y(), truth_.y(), 0.02);
  EXPECT_NEAR(found.theta(), truth_.theta(), 0.01);
  EXPECT_GT(pose.pose.covariance[0], 0.0);
  EXPECT_NE(pose.pose.covariance[1], 0.0) << "cross terms are filled";
  const TrackerStatus status = messagesAt(stamp, statuses)[0];
  EXPECT_EQ(status.state, TrackerStatus::TRACKING);
  EXPECT_EQ(status.room, "living_room");
  EXPECT_EQ(status.walls.size(), 4U);
  EXPECT_GT(status.quality, 0.9);
}

TEST_F(RoomTrackerNode, BroadcastsMapToOdom) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  Recorder<PoseMessage> poses("pose");
  scanUntil(poses, 3);
  ASSERT_TRUE(comesTrue([&] { return buffer.canTransform("map", "odom", ros::Time(0)); },
                        [this] { scan(); }));
  const auto T_map_odom = buffer.lookupTransform("map", "odom", ros::Time(0));
  const Pose2 composed = bridge::toPose2(T_map_odom.transform) * odometry_;
  EXPECT_NEAR(composed.x(), truth_.x(), 0.02);
  EXPECT_NEAR(composed.y(), truth_.y(), 0.02);
  EXPECT_NEAR(composed.theta(), truth_.theta(), 0.01);
}

TEST_F(RoomTrackerNode, LatchesTheFloorAsAGrid) {
  Recorder<nav_msgs::OccupancyGrid> maps("map");
  const auto received = maps.atLeast(1);
  ASSERT_FALSE(received.empty());
  EXPECT_EQ(received[0].header.frame_id, "map");
  EXPECT_EQ(received[0].data.size(), received[0].info.width * received[0].info.height);
  EXPECT_THAT(received[0].data, testing::Contains(100));
  EXPECT_THAT(received[0].data, testing::Contains(0));
}

TEST_F(RoomTrackerNode, DrawsWallsGatesPointsAndEllipse) {
  Recorder<visualization_msgs::MarkerArray> markers("room_markers");
  const auto array = scanUntil(markers);
  std::vector<std::string> names;
  for (const auto& marker : array.markers) {
    names.push_back(marker.ns);
    EXPECT_EQ(marker.header.frame_id, "map");
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("walls", "gates", "accepted", "position 95 %",
                                                   "rivals", "room"));
}

TEST_F(RoomTrackerNode, Services) {
  SetRoom room;
  room.request.room = "cellar";
  ASSERT_TRUE(ros::service::call("room_tracker/set_room", room));
  EXPECT_FALSE(room.response.success);
  EXPECT_EQ(room.response.message, "no room is called 'cellar'");
  room.request.room = "living_room";
  ASSERT_TRUE(ros::service::call("room_tracker/set_room", room));
  EXPECT_TRUE(room.response.success);

  InflateUncertainty inflate;
  inflate.request.position = -1.0;
  ASSERT_TRUE(ros::service::call("room_tracker/inflate_uncertainty", inflate));
  EXPECT_FALSE(inflate.response.success);
  inflate.request.position = 0.4;
  ASSERT_TRUE(ros::service::call("room_tracker/inflate_uncertainty", inflate));
  EXPECT_TRUE(inflate.response.success);
}

TEST(RoomTrackerProgram, RefusesABadRoomsFileWithFileLineAndKey) {
  const std::string said =
      test::refusalOf("room_tracker", "_map:=" SIGHTLINE_SOURCE_DIR "/config/sensors/utm30lx.yaml");
  EXPECT_THAT(said, testing::ContainsRegex("utm30lx.yaml:[0-9]+: [a-z_]+: unknown key"));
}

}  // namespace
}  // namespace sightline
