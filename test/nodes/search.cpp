// A robot that sees nothing, and where search sends it.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include "nodes/comes_true.h"
#include "nodes/recorder.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/bridge/time.h"

namespace sightline {
namespace {

TEST(SearchNode, SendsARobotOnItsWay) {
  ros::NodeHandle node;
  const auto looks = node.advertise<BearingArray>("red/bearings", 100);
  const auto poses = node.advertise<geometry_msgs::PoseWithCovarianceStamped>("red/pose", 100);
  const test::Recorder<nav_msgs::Path> actions("red/action");
  const test::Recorder<nav_msgs::Path> none("absent/action");
  const test::Recorder<geometry_msgs::Twist> commands("red/cmd_vel");
  const test::Recorder<visualization_msgs::MarkerArray> markers("search_markers");
  ASSERT_TRUE(test::comesTrue([&] {
    return looks.getNumSubscribers() > 0 && poses.getNumSubscribers() > 0 &&
           markers.publishers() > 0;
  }));
  const geometry::Pose2 pose(1.0, 2.0, 0.3);
  const auto look = [&] {
    const ros::Time stamp = ros::Time::now();
    geometry_msgs::PoseWithCovarianceStamped at;
    at.header.stamp = stamp;
    at.header.frame_id = "map";
    at.pose.pose = bridge::toPose(pose);
    poses.publish(at);
    targets::BearingSet set;
    set.stamp = bridge::nanoseconds(stamp);
    set.range_max = 5.0;
    looks.publish(bridge::toMessage(set, "red/laser"));
  };
  ASSERT_TRUE(test::comesTrue([&] { return actions.count() >= 4; }, look));
  const nav_msgs::Path first = actions.all().front();
  EXPECT_EQ(first.header.frame_id, "map");
  EXPECT_EQ(first.poses.size(), 3U);
  const auto is_driven = [&] {
    for (const geometry_msgs::Twist& command : commands.all()) {
      if (command.linear.x > 0.1 || command.angular.z != 0.0) return true;
    }
    return false;
  };
  EXPECT_TRUE(test::comesTrue(is_driven, look));
  EXPECT_FALSE(markers.atLeast(1).empty());
  EXPECT_EQ(none.count(), 0U);
}

}  // namespace
}  // namespace sightline
