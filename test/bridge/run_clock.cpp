#include "sightline/bridge/run_clock.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sightline/bridge/odometry_conversion.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {
namespace {

class FollowingClock : public testing::Test {
 protected:
  static constexpr std::int64_t kSecond = 1'000'000'000;

  void SetUp() override {
    ros::Time::init();
    ros::Time::setNow(ros::Time());
  }
  void TearDown() override { ros::Time::init(); }

  RunClock clock_;
};

TEST_F(FollowingClock, StandsStillUntilThereIsATime) {
  EXPECT_EQ(clock_.due(0), 0);
  ros::Time::setNow(ros::Time(50.0));
  EXPECT_EQ(clock_.due(0), 0);
  EXPECT_EQ(clock_.stampOf(0), 50 * kSecond);
}

TEST_F(FollowingClock, RunsAsRosDoes) {
  ros::Time::setNow(ros::Time(50.0));
  clock_.due(0);
  ros::Time::setNow(ros::Time(50.25));
  EXPECT_EQ(clock_.due(0), kSecond / 4);
  EXPECT_EQ(clock_.stampOf(kSecond / 4), 50 * kSecond + kSecond / 4);
}

TEST_F(FollowingClock, GoesOnFromWhereItIsWhenRosJumps) {
  ros::Time::setNow(ros::Time(50.0));
  clock_.due(0);
  ros::Time::setNow(ros::Time(51.0));
  EXPECT_EQ(clock_.due(kSecond), kSecond);
  for (const double jump : {900.0, 20.0}) {
    ros::Time::setNow(ros::Time(jump));
    EXPECT_EQ(clock_.due(kSecond), kSecond);
    EXPECT_EQ(clock_.stampOf(kSecond), std::llround(jump * 1e9));
  }
}

TEST(OdometryMessage, HoldsPoseTwistAndTheirCovariances) {
  geometry::UncertainPose2 pose{{1.0, 2.0, 0.5}, Eigen::Matrix3d::Zero()};
  pose.covariance << 1, 2, 3, 2, 5, 6, 3, 6, 9;
  const geometry::UncertainTwist2 twist{{0.4, 0.01, -0.2}, 0.1 * pose.covariance};
  const auto message = toOdometryMessage({7'000'000'005, "odom", "base_link"}, pose, twist);
  EXPECT_EQ(message.header.stamp, ros::Time(7, 5));
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_TRUE(toPose2(message.pose.pose).coordinates().isApprox(pose.mean.coordinates(), 1e-12));
  EXPECT_EQ(message.pose.covariance[0], 1.0);
  EXPECT_EQ(message.pose.covariance[5], 3.0);
  EXPECT_EQ(message.pose.covariance[35], 9.0);
  EXPECT_EQ(message.twist.twist.linear.x, 0.4);
  EXPECT_EQ(message.twist.twist.linear.y, 0.01);
  EXPECT_EQ(message.twist.twist.angular.z, -0.2);
  EXPECT_DOUBLE_EQ(message.twist.covariance[11], 0.6);
}

}  // namespace
}  // namespace sightline::bridge
