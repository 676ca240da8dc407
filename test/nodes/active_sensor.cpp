#include <cmath>
#include <limits>

#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <sightline/HeadCommand.h>
#include <sightline/LineSegmentArray.h>
#include <sightline/RangeScan.h>
#include "nodes/comes_true.h"
#include "nodes/diagnostics.h"
#include "nodes/recorder.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/geometry/polar_line.h"

namespace sightline {
namespace {

using test::Recorder;

class ActiveSensorNode : public testing::Test {
 protected:
  void command(std::uint8_t mode, double position, double rate, const std::string& joint = "") {
    HeadCommand message;
    message.joint = joint;
    message.mode = mode;
    message.position = position;
    message.rate = rate;
    EXPECT_TRUE(test::comesTrue([this] { return commands_.getNumSubscribers() > 0; }));
    commands_.publish(message);
  }
  // The head's position once it stands still near `position`.
  double positionNear(double position) {
    for (int i = 0; i < 500; ++i) {
      const auto state = joints_.next();
      if (state.velocity.empty()) break;
      if (state.velocity[0] == 0.0 && std::abs(state.position[0] - position) < 0.01) {
        return state.position[0];
      }
    }
    ADD_FAILURE() << "the head does not come to " << position;
    return std::nan("");
  }
  void expectRefused(const std::string& reason) {
    diagnostics_.expectValue("sim_sensor: input /head_command", "last reason", reason);
  }

  ros::NodeHandle node_;
  ros::Publisher commands_ = node_.advertise<HeadCommand>("head_command", 10);
  Recorder<sensor_msgs::JointState> joints_{"joint_states"};
  test::Diagnostics diagnostics_;
};

TEST_F(ActiveSensorNode, PublishesEachScanInBothForms) {
  Recorder<RangeScan> range_scans("range_scan");
  Recorder<sensor_msgs::LaserScan> scans("scan");
  range_scans.atLeast(8);
  scans.atLeast(8);
  std::size_t pairs = 0;
  for (const auto& range_scan : range_scans.all()) {
    EXPECT_EQ(range_scan.header.frame_id, "projection");
    EXPECT_EQ(range_scan.mount_frame, "active_sensor");
    EXPECT_EQ(range_scan.variances.size(), 256u);
    EXPECT_EQ(range_scan.head_angles.size(), 256u);
    EXPECT_NEAR(range_scan.scan_time, 0.1024, 1e-6);
    EXPECT_NEAR(range_scan.time_increment, 4e-4, 1e-9);
    EXPECT_GT(range_scan.currents[128], 1e-9F);
    for (const auto& scan : scans.all()) {
      if (scan.header.stamp != range_scan.header.stamp) continue;
      ++pairs;
      EXPECT_EQ(scan.header.frame_id, "projection");
      EXPECT_EQ(scan.ranges[128], range_scan.ranges[128]);
      EXPECT_NEAR(scan.intensities[128], 1e9F * range_scan.currents[128], 1e-4);
    }
  }
  EXPECT_GE(pairs, 6u);
}

TEST_F(ActiveSensorNode, TurnsItsHeadAsItIsTold) {
  command(HeadCommand::POSITION, 0.2, 0.0, "head_joint");
  EXPECT_NEAR(positionNear(0.2), 32 * geometry::radians(0.36), 1e-9);
  command(HeadCommand::POSITION, 0.0, 1.0);
  positionNear(0.0);
}

TEST_F(ActiveSensorNode, RefusesCommandsThatNoHeadCanFollow) {
  const double position = positionNear(0.0);
  command(HeadCommand::POSITION, 2.0, 0.0);
  expectRefused("beyond the limits");
  command(HeadCommand::RATE, 0.0, std::nan(""));
  expectRefused("a rate that is not finite");
  command(HeadCommand::POSITION, 0.5, -1.0);
  expectRefused("a rate below 0 on the way to a position");
  command(HeadCommand::POSITION, 0.5, 0.0, "elbow");  // is for another head
  command(7, 0.5, 0.0);
  expectRefused("an unknown mode 7");
  EXPECT_EQ(positionNear(0.0), position);
}

// The faces of the edge do not move, however the head turns and the robot drives, whether that is
// told by the range scan or by tf.
TEST_F(ActiveSensorNode, LinesStandStillWhileHeadAndRobotMove) {
  tf2_ros::Buffer buffer(ros::Duration(30.0));
  tf2_ros::TransformListener listener(buffer);
  Recorder<LineSegmentArray> lines("lines");
  Recorder<LineSegmentArray> lines_of_scan("plain/lines");
  const ros::Publisher drive = node_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
  lines.atLeast(1);
  const ros::Time began = lines.next().header.stamp;
  geometry_msgs::Twist velocity;
  velocity.linear.x = 0.15;
  for (int i = 0; i < 24; ++i) {  // scans of 0.1 s
    if (i % 8 == 0) command(HeadCommand::RATE, 0.0, i % 16 == 0 ? 0.4 : -0.4);
    drive.publish(velocity);
    lines.next();
  }
  command(HeadCommand::POSITION, 0.0, 0.0);
  // Calls for each segment since the start, with T_odom_projection at its stamp.
  const auto forEach = [&](const Recorder<LineSegmentArray>& recorder, const auto& call) {
    for (const auto& array : recorder.all()) {
      if (array.header.stamp < began) continue;
      if (!buffer.canTransform("odom", "projection", array.header.stamp, ros::Duration(2.0))) {
        continue;
      }
      const auto T_odom_projection = bridge::toPose2(
          buffer.lookupTransform("odom", "projection", array.header.stamp).transform);
      for (const auto& segment : array.segments) call(segment, T_odom_projection);
    }
  };
  std::vector<double> told;  // distances of the faces from the place where the robot started
  forEach(lines, [&](const LineSegment& segment, const geometry::Pose2& T_odom_projection) {
    const geometry::PolarLine line{segment.rho, segment.phi, Eigen::Matrix2d::Zero()};
    told.push_back(geometry::transform(T_odom_projection, line).rho);
  });
  // Between the ends of a sweep, in which the head accelerates, tf interpolates: faces are bent
  // there, and found in parts. The middles of these are where the faces are.
  std::vector<double> through_tf;
  forEach(lines_of_scan, [&](const LineSegment& segment, const geometry::Pose2& T_odom_projection) {
    const Eigen::Vector2d middle(0.5 * (segment.start.x + segment.end.x),
                                 0.5 * (segment.start.y + segment.end.y));
    const Eigen::Vector2d p_odom = T_odom_projection * middle;
    through_tf.push_back((p_odom.x() - std::abs(p_odom.y())) / std::sqrt(2.0));
  });
  ASSERT_GT(told.size(), 15u);
  ASSERT_GT(through_tf.size(), 15u);
  const double truth = 1.3 / std::sqrt(2.0);  // both faces, from (0.2, -1.5)
  EXPECT_THAT(told, testing::Each(testing::DoubleNear(truth, 0.03)));
  EXPECT_THAT(through_tf, testing::Each(testing::DoubleNear(truth, 0.08)));
}

}  // namespace
}  // namespace sightline
