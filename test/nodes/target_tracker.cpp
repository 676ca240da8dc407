// Two robots that circle a target, as target_tracker sees them.
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>

#include "nodes/comes_true.h"
#include "nodes/recorder.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/bridge/time.h"

namespace sightline {
namespace {

using geometry::Pose2;

/// A robot that reports where it is and what it sees.
class BearingRobot {
 public:
  explicit BearingRobot(const std::string& name)
      : name_(name),
        bearings_(node_.advertise<BearingArray>(name + "/bearings", 100)),
        poses_(node_.advertise<geometry_msgs::PoseWithCovarianceStamped>(name + "/pose", 100)) {}

  bool isConnected() const {
    return bearings_.getNumSubscribers() > 0 && poses_.getNumSubscribers() > 0;
  }

  BearingArray lookOf(const ros::Time& stamp, const Pose2& pose,
                      const Eigen::Vector2d& target) const {
    targets::BearingSet set;
    set.stamp = bridge::nanoseconds(stamp);
    set.field_of_view = {-2.3, 2.3};
    set.range_max = 5.0;
    set.bearings = {targets::polarOf(pose.inverse() * target).bearing};
    return bridge::toMessage(set, name_ + "/laser");
  }

  void sendPose(const ros::Time& stamp, const Pose2& pose) {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = "map";
    message.pose.pose = bridge::toPose(pose);
    poses_.publish(message);
  }
  void send(const BearingArray& look) { bearings_.publish(look); }

 private:
  ros::NodeHandle node_;
  std::string name_;
  ros::Publisher bearings_;
  ros::Publisher poses_;
};

TEST(TargetTrackerNode, TwoRobotsFindATargetAndBadLooksDoNoHarm) {
  const Eigen::Vector2d target(2.0, 1.0);
  BearingRobot red("red");
  BearingRobot blue("blue");
  const test::Recorder<TargetArray> targets("targets");
  const test::Recorder<visualization_msgs::MarkerArray> markers("target_markers");
  ASSERT_TRUE(test::comesTrue([&] { return red.isConnected() && blue.isConnected(); }));
  std::size_t i = 0;
  const auto step = [&] {
    const ros::Time stamp = ros::Time::now();
    const double angle = 0.2 * static_cast<double>(i++);
    const Eigen::Vector2d off(1.8 * std::cos(angle), 1.8 * std::sin(angle));
    const Pose2 of_red(target + off, angle + geometry::kPi);
    const Pose2 of_blue(target - off, angle);
    red.sendPose(stamp, of_red);
    blue.sendPose(stamp, of_blue);
    BearingArray bad = red.lookOf(stamp, of_red, target);
    bad.bearings.push_back(std::numeric_limits<double>::quiet_NaN());
    red.send(bad);
    BearingArray blind = blue.lookOf(stamp, of_blue, target);
    blind.field_of_view_max = blind.field_of_view_min;
    blue.send(blind);
    red.send(red.lookOf(stamp, of_red, target));
    blue.send(blue.lookOf(stamp, of_blue, target));
  };
  const auto is_found = [&] {
    const auto all = targets.all();
    return !all.empty() && all.back().targets.size() == 1 &&
           all.back().targets[0].probability > 0.9 && all.size() > 20;
  };
  ASSERT_TRUE(test::comesTrue(is_found, step));
  const TargetArray last = targets.all().back();
  EXPECT_EQ(last.header.frame_id, "map");
  EXPECT_EQ(last.targets[0].label, 1U);
  EXPECT_NEAR(last.targets[0].position.x, target.x(), 0.2);
  EXPECT_NEAR(last.targets[0].position.y, target.y(), 0.2);
  EXPECT_NEAR(last.expected_number, 1.0, 0.3);
  EXPECT_FALSE(markers.atLeast(1).empty());
}

}  // namespace
}  // namespace sightline
