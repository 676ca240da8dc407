#include <cmath>
#include <limits>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sys/wait.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include "nodes/recorder.h"
#include "sightline/InflateUncertainty.h"
#include "sightline/SetRoom.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/room_messages.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/simulation/scanner.h"

namespace sightline {
namespace {

using geometry::Pose2;
using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;

using test::Recorder;

// Plays the robot: stands in the living room, with odometry that says something else, and a scanner
// mounted aside.
class RoomTrackerNode : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    static tf2_ros::StaticTransformBroadcaster mounting;
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "base_link";
    transform.child_frame_id = "laser";
    transform.transform = bridge::toTransform({0.2, 0.1, 0.3});
    mounting.sendTransform(transform);
  }

  RoomTrackerNode()
      : scanner_(profile(), mounting(), 3),
        scan_publisher_(node_.advertise<sensor_msgs::LaserScan>("scan", 10)),
        initial_pose_publisher_(node_.advertise<PoseMessage>("waiting/initialpose", 10)) {
    const world::RoomMap map = world::RoomMap::readFile(std::string(SIGHTLINE_SOURCE_DIR) +
                                                        "/config/rooms/living_room.yaml");
    for (const geometry::Segment& wall : world::solidWalls(map)) {
      world::WorldSegment segment;
      segment.segment = wall;
      world_.add(segment);
    }
    waitForSubscribers(scan_publisher_, 2);
  }

  static simulation::ScannerProfile profile() {
    simulation::ScannerProfile profile;
    profile.beams = 361;
    profile.revolution = 0.0;
    profile.noise.sigma = 0.01;
    return profile;
  }

  static simulation::Mounting mounting() {
    simulation::Mounting mounting;
    mounting.x = 0.2;
    mounting.y = 0.1;
    mounting.z = 0.4;
    mounting.yaw = 0.3;
    return mounting;
  }

  static void waitForSubscribers(const ros::Publisher& publisher, std::uint32_t count) {
    while (ros::ok() && publisher.getNumSubscribers() < count) ros::WallDuration(0.02).sleep();
  }

  void sendOdometry(const ros::Time& stamp) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = "odom";
    transform.child_frame_id = "base_link";
    transform.transform = bridge::toTransform(odometry_);
    broadcaster_.sendTransform(transform);
  }

  sensor_msgs::LaserScan look(const ros::Time& stamp) {
    auto message =
        bridge::toMessage(scanner_.sweep(world_, 1, [&](std::int64_t) { return truth_; }));
    message.header.stamp = stamp;
    message.header.frame_id = "laser";
    return message;
  }

  ros::Time scan() {
    const ros::Time now = ros::Time::now();
    sendOdometry(now);
    scan_publisher_.publish(look(now));
    return now;
  }

  // Scans until there are that many answers: the first scans may come before tf has.
  template <class Message>
  Message scanUntil(Recorder<Message>& answers, std::size_t count = 1) {
    for (int i = 0; i < 200 && answers.count() < count; ++i) {
      scan();
      ros::WallDuration(0.05).sleep();
    }
    const auto messages = answers.atLeast(count);
    return messages.empty() ? Message() : messages.back();
  }

  void sendInitialPose(const std::string& frame, double x) {
    waitForSubscribers(initial_pose_publisher_, 1);
    PoseMessage message;
    message.header.frame_id = frame;
    message.pose.pose = bridge::toPose(truth_);
    message.pose.pose.position.x = x;
    initial_pose_publisher_.publish(message);
    ros::WallDuration(0.2).sleep();
  }

  ros::NodeHandle node_;
  Pose2 truth_{-1.05, 0.45, 0.33};
  Pose2 odometry_{5.0, 3.0, -1.0};
  world::World world_;
  simulation::Scanner scanner_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher scan_publisher_;
  ros::Publisher initial_pose_publisher_;
};

TEST_F(RoomTrackerNode, TracksWithTheStampOfTheScan) {
  Recorder<PoseMessage> poses("pose");
  Recorder<TrackerStatus> statuses("tracker_status");
  scanUntil(poses, 5);
  ros::WallDuration(0.5).sleep();
  const std::size_t before = poses.count();
  const ros::Time stamp = scan();
  poses.atLeast(before + 1);
  ros::WallDuration(0.2).sleep();
  ASSERT_EQ(poses.count(), before + 1) << "one output for one scan";
  const PoseMessage pose = poses.all().back();
  EXPECT_EQ(pose.header.stamp, stamp);
  EXPECT_EQ(pose.header.frame_id, "map");
  const Pose2 found = bridge::toPose2(pose.pose.pose);
  EXPECT_NEAR(found.x(), truth_.x(), 0.02);
  EXPECT_NEAR(found.y(), truth_.y(), 0.02);
  EXPECT_NEAR(found.theta(), truth_.theta(), 0.01);
  EXPECT_GT(pose.pose.covariance[0], 0.0);
  EXPECT_NE(pose.pose.covariance[1], 0.0) << "cross terms are filled";
  const TrackerStatus status = statuses.all().back();
  EXPECT_EQ(status.header.stamp, stamp);
  EXPECT_EQ(status.state, TrackerStatus::TRACKING);
  EXPECT_EQ(status.room, "living_room");
  EXPECT_EQ(status.walls.size(), 4U);
  EXPECT_GT(status.quality, 0.9);
}

TEST_F(RoomTrackerNode, BroadcastsMapToOdom) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  Recorder<PoseMessage> poses("pose");
  const PoseMessage pose = scanUntil(poses, 3);
  geometry_msgs::TransformStamped T_map_base;
  for (int i = 0; i < 100; ++i) {
    scan();
    ros::WallDuration(0.05).sleep();
    if (buffer.canTransform("map", "odom", ros::Time(0))) break;
  }
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
  EXPECT_THAT(names,
              testing::UnorderedElementsAre("walls", "gates", "accepted", "position 95 %", "room"));
}

TEST_F(RoomTrackerNode, BadScansAreDroppedWithTheirReasonAndGoodOnesStillUsed) {
  Recorder<PoseMessage> poses("pose");
  Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  scanUntil(poses, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ros::Time now = ros::Time::now();
  sendOdometry(now);
  auto no_beams = look(now);
  no_beams.ranges.clear();
  no_beams.intensities.clear();
  auto no_increment = look(now);
  no_increment.angle_increment = static_cast<float>(nan);
  auto intensities = look(now);
  intensities.intensities.resize(3);
  auto no_stamp = look(ros::Time());
  auto long_ago = look(now - ros::Duration(0.5));
  const std::size_t before = poses.count();
  for (const auto& bad : {no_beams, no_increment, intensities, no_stamp, long_ago}) {
    scan_publisher_.publish(bad);
  }
  ros::WallDuration(0.8).sleep();
  EXPECT_EQ(poses.count(), before);
  scanUntil(poses, before + 1);
  const auto saysThatItDropped = [&] {
    for (const auto& array : diagnostics.all()) {
      for (const auto& status : array.status) {
        if (status.message.rfind("dropped: ", 0) == 0) return true;
      }
    }
    return false;
  };
  for (int i = 0; i < 100 && !saysThatItDropped(); ++i) {
    scan_publisher_.publish(no_beams);
    ros::WallDuration(0.1).sleep();
  }
  EXPECT_TRUE(saysThatItDropped());
}

TEST_F(RoomTrackerNode, ScanWithoutOdometryIsDroppedAfterTheTimeOut) {
  Recorder<PoseMessage> poses("pose");
  scanUntil(poses, 2);
  ros::WallDuration(0.5).sleep();
  const std::size_t before = poses.count();
  scan_publisher_.publish(look(ros::Time::now() + ros::Duration(0.1)));  // no odometry reaches it
  ros::WallDuration(0.6).sleep();
  EXPECT_EQ(poses.count(), before);
  scanUntil(poses, before + 1);
}

TEST_F(RoomTrackerNode, ScanFromBeforeTheOdometryDoesNotHoldUpTheNext) {
  Recorder<PoseMessage> poses("patient/pose");
  ros::Publisher scans = node_.advertise<sensor_msgs::LaserScan>("patient/scan", 10);
  waitForSubscribers(scans, 1);
  scans.publish(look(ros::Time::now() - ros::Duration(60.0)));
  for (int i = 0; i < 200 && poses.count() == 0; ++i) {
    scans.publish(look(scan()));
    ros::WallDuration(0.05).sleep();
  }
  EXPECT_GT(poses.count(), 0U);
}

TEST_F(RoomTrackerNode, WaitsForAPoseAndRefusesBadOnes) {
  Recorder<PoseMessage> poses("waiting/pose");
  Recorder<TrackerStatus> statuses("waiting/tracker_status");
  EXPECT_EQ(scanUntil(statuses).state, TrackerStatus::INITIALISING);
  sendInitialPose("odom", truth_.x());
  sendInitialPose("waiting/map", std::numeric_limits<double>::quiet_NaN());
  scanUntil(statuses, statuses.count() + 3);
  EXPECT_EQ(poses.count(), 0U);
  sendInitialPose("waiting/map", truth_.x() + 0.1);
  const PoseMessage pose = scanUntil(poses);
  EXPECT_EQ(pose.header.frame_id, "waiting/map");
  EXPECT_NEAR(pose.pose.pose.position.x, truth_.x(), 0.03);
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

TEST_F(RoomTrackerNode, ClockSetBackStartsAgain) {
  Recorder<PoseMessage> poses("waiting/pose");
  Recorder<TrackerStatus> statuses("tracker_status");
  scanUntil(statuses, 2);
  const ros::Time earlier = ros::Time::now() - ros::Duration(5.0);
  const std::size_t before = statuses.count();
  for (int i = 0; i < 40 && statuses.count() == before; ++i) {
    const ros::Time stamp = earlier + ros::Duration(0.05 * i);
    sendOdometry(stamp);
    scan_publisher_.publish(look(stamp));
    ros::WallDuration(0.05).sleep();
  }
  const auto all = statuses.atLeast(before + 1);
  EXPECT_LT(all.back().header.stamp, earlier + ros::Duration(2.1));
  EXPECT_EQ(all.back().state, TrackerStatus::TRACKING);
}

TEST(RoomTrackerProgram, RefusesABadRoomsFileWithFileLineAndKey) {
  const std::string command =
      "rosrun sightline room_tracker __name:=refused _map:=" + std::string(SIGHTLINE_SOURCE_DIR) +
      "/config/sensors/utm30lx.yaml 2>&1";
  FILE* program = popen(command.c_str(), "r");
  ASSERT_TRUE(program);
  std::string said;
  for (int c = fgetc(program); c != EOF; c = fgetc(program)) said += static_cast<char>(c);
  EXPECT_EQ(WEXITSTATUS(pclose(program)), 1);
  EXPECT_THAT(said, testing::ContainsRegex("utm30lx.yaml:[0-9]+: [a-z_]+: unknown key"));
}

}  // namespace
}  // namespace sightline
