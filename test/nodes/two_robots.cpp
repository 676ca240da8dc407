// Two robots under robot.launch.
#include <set>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include "nodes/comes_true.h"
#include "nodes/recorder.h"
#include "sightline/LineSegmentArray.h"

namespace sightline {
namespace {

using test::Recorder;

TEST(TwoRobots, EachHasItsPoseLinesAndTransform) {
  Recorder<tf2_msgs::TFMessage> transforms("/tf");
  const auto isBroadcast = [&](const std::string& child) {
    for (const auto& message : transforms.all()) {
      for (const auto& transform : message.transforms) {
        if (transform.header.frame_id == "map" && transform.child_frame_id == child) return true;
      }
    }
    return false;
  };
  for (const std::string robot : {"ann", "bob"}) {
    const Recorder<geometry_msgs::PoseWithCovarianceStamped> poses("/" + robot + "/pose");
    const Recorder<LineSegmentArray> lines("/" + robot + "/lines");
    const auto pose = poses.next();
    EXPECT_NEAR(pose.pose.pose.position.x, robot == "ann" ? -1.0 : 0.6, 0.1);
    EXPECT_EQ(lines.next().header.frame_id, robot + "/laser");
    EXPECT_TRUE(test::comesTrue([&] { return isBroadcast(robot + "/odom"); })) << robot;
  }
}

}  // namespace
}  // namespace sightline
