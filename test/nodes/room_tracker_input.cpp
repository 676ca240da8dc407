// What room_tracker makes of scans, odometry, poses and clocks that are not as they should be.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include "nodes/diagnostics.h"
#include "nodes/living_room_robot.h"
#include "nodes/recorder.h"
#include "sightline/TrackerStatus.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline {
namespace {

using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;
using test::comesTrue;
using test::Recorder;
using test::waitForConnection;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

class RoomTrackerInput : public test::LivingRoomRobot {
 protected:
  PoseMessage initialPose(const std::string& frame, double x) const {
    PoseMessage message;
    message.header.frame_id = frame;
    message.pose.pose = bridge::toPose(truth_);
    message.pose.pose.position.x = x;
    return message;
  }

  test::Diagnostics diagnostics_;
};

template <class Message>
bool holds(const Recorder<Message>& recorder, const ros::Time& stamp) {
  const auto all = recorder.all();
  return std::any_of(all.begin(), all.end(),
                     [&](const Message& message) { return message.header.stamp == stamp; });
}

TEST_F(RoomTrackerInput, BadScansAreDroppedWithTheirReasonAndGoodOnesStillUsed) {
  Recorder<PoseMessage> poses("pose");
  scanUntil(poses, 2);
  const ros::Time now = ros::Time::now();
  sendOdometry(now);
  auto no_beams = look(now);
  no_beams.ranges.clear();
  no_beams.intensities.clear();
  auto no_increment = look(now);
  no_increment.angle_increment = static_cast<float>(kNoNumber);
  no_increment.angle_max = no_increment.angle_min;
  const auto no_stamp = look(ros::Time());
  const ros::Time first = poses.all().front().header.stamp;
  const auto long_ago = look(first + ros::Duration(0.001));  // the odometry had begun
  const std::vector<std::pair<sensor_msgs::LaserScan, std::string>> bad{
      {no_beams, "no beams"},
      {no_increment, "an angle increment of nan"},
      {no_stamp, "a stamp of zero"},
      {long_ago, "older than the scan before it"}};
  for (const auto& [message, reason] : bad) {
    scan_publisher_.publish(message);
    diagnostics_.expectValue("room_tracker: input /scan", "last reason", reason);
  }
  scanUntil(poses, poses.count() + 1);
  for (const auto& [message, reason] : bad)
    EXPECT_FALSE(holds(poses, message.header.stamp)) << reason;
}

TEST_F(RoomTrackerInput, ScanWithoutOdometryIsDroppedAfterTheTimeOut) {
  Recorder<PoseMessage> poses("pose");
  scanUntil(poses, 2);
  const auto early = look(ros::Time::now() + ros::Duration(0.1));  // no odometry reaches it
  scan_publisher_.publish(early);
  diagnostics_.expectValue("room_tracker: input /scan", "last reason",
                           "no odometry from odom to base_link at its time");
  scanUntil(poses, poses.count() + 1);
  EXPECT_FALSE(holds(poses, early.header.stamp));
}

TEST_F(RoomTrackerInput, ScanFromBeforeTheOdometryDoesNotHoldUpTheNext) {
  Recorder<PoseMessage> poses("patient/pose");
  ros::Publisher scans = node_.advertise<sensor_msgs::LaserScan>("patient/scan", 10);
  waitForConnection(ros::this_node::getName(), "/patient/scan", "/patient/room_tracker");
  scans.publish(look(ros::Time::now() - ros::Duration(60.0)));
  EXPECT_TRUE(comesTrue([&] { return poses.count() > 0; }, [&] { scans.publish(look(scan())); }));
}

TEST_F(RoomTrackerInput, WaitsForAPoseAndRefusesBadOnes) {
  Recorder<PoseMessage> poses("waiting/pose");
  Recorder<TrackerStatus> statuses("waiting/tracker_status");
  Recorder<rosgraph_msgs::Log> logs("/rosout");
  const ros::Publisher initial = node_.advertise<PoseMessage>("waiting/initialpose", 10);
  waitForConnection(ros::this_node::getName(), "/waiting/initialpose", "/waiting/room_tracker");
  EXPECT_EQ(scanUntil(statuses).state, TrackerStatus::INITIALISING);
  const auto isRefused = [&](const std::string& reason) {
    const auto all = logs.all();
    return std::any_of(all.begin(), all.end(), [&](const rosgraph_msgs::Log& log) {
      return log.name == "/waiting/room_tracker" &&
             log.msg.find("initialpose refused: " + reason) == 0;
    });
  };
  EXPECT_TRUE(comesTrue([&] { return isRefused("in frame 'odom' instead of 'waiting/map'"); },
                        [&] { initial.publish(initialPose("odom", truth_.x())); }));
  EXPECT_TRUE(comesTrue([&] { return isRefused("a position that is not finite"); },
                        [&] { initial.publish(initialPose("waiting/map", kNoNumber)); }));
  scanUntil(statuses, statuses.count() + 3);
  EXPECT_EQ(poses.count(), 0U);
  initial.publish(initialPose("waiting/map", truth_.x() + 0.1));
  const PoseMessage pose = scanUntil(poses);
  EXPECT_EQ(pose.header.frame_id, "waiting/map");
  EXPECT_NEAR(pose.pose.pose.position.x, truth_.x(), 0.03);
}

TEST_F(RoomTrackerInput, RoomsAreDrawnBeforeThereIsAPose) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  const Recorder<visualization_msgs::MarkerArray> drawings("unlocated/room_markers");
  const auto messages = drawings.atLeast(1);
  ASSERT_FALSE(messages.empty());
  const auto& markers = messages.front().markers;
  ASSERT_GE(markers.size(), 2U);
  EXPECT_GE(markers[0].points.size(), 8U) << "four walls";
  EXPECT_EQ(markers[1].text, "no scan was used yet:\nsee the terminal, or /diagnostics");
  EXPECT_TRUE(comesTrue(
      [&] { return buffer.canTransform("unlocated/map", "unlocated/map_rooms", ros::Time(0)); },
      [] {}));
}

TEST_F(RoomTrackerInput, ClockSetBackStartsAgain) {
  Recorder<TrackerStatus> statuses("tracker_status");
  scanUntil(statuses, 2);
  const ros::Time earlier = ros::Time::now() - ros::Duration(5.0);
  const ros::Time last = earlier + ros::Duration(3.0);
  ros::Time stamp = earlier;
  EXPECT_TRUE(comesTrue(
      [&] {
        const auto all = statuses.all();
        return all.back().header.stamp <= last && all.back().state == TrackerStatus::TRACKING;
      },
      [&] {
        sendOdometry(stamp);
        scan_publisher_.publish(look(stamp));
        stamp = std::min(stamp + ros::Duration(0.05), last);
      }));
}

}  // namespace
}  // namespace sightline
