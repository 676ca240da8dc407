#include "sightline/bridge/initial_pose.h"
#include "sightline/bridge/bad_message.h"

#include <limits>

#include <gtest/gtest.h>

#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {
namespace {

const std::array<double, 2> kSigma{0.3, 0.1};

geometry_msgs::PoseWithCovarianceStamped goodMessage() {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.frame_id = "map";
  message.pose.pose = toPose({1.0, -2.0, 0.5});
  message.pose.covariance = toCovariance6(Eigen::Vector3d(0.04, 0.09, 0.01).asDiagonal());
  return message;
}

std::string reasonFor(const geometry_msgs::PoseWithCovarianceStamped& message) {
  try {
    readInitialPose(message, "map", kSigma);
  } catch (const BadMessage& fault) {
    return fault.what();
  }
  return "";
}

TEST(InitialPose, IsRead) {
  const auto pose = readInitialPose(goodMessage(), "map", kSigma);
  EXPECT_NEAR(pose.mean.x(), 1.0, 1e-12);
  EXPECT_NEAR(pose.mean.y(), -2.0, 1e-12);
  EXPECT_NEAR(pose.mean.theta(), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(pose.covariance(1, 1), 0.09);
}

TEST(InitialPose, LeadingSlashIsTheSameFrame) {
  auto message = goodMessage();
  message.header.frame_id = "/map";
  EXPECT_EQ(reasonFor(message), "");
}

TEST(InitialPose, NoCovarianceIsReplaced) {
  auto message = goodMessage();
  message.pose.covariance.fill(0.0);
  const auto pose = readInitialPose(message, "map", kSigma);
  EXPECT_DOUBLE_EQ(pose.covariance(0, 0), 0.09);
  EXPECT_DOUBLE_EQ(pose.covariance(2, 2), 0.01);
}

TEST(InitialPose, FaultsAreNamed) {
  auto message = goodMessage();
  message.header.frame_id = "odom";
  EXPECT_EQ(reasonFor(message), "in frame 'odom' instead of 'map'");

  message = goodMessage();
  message.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reasonFor(message), "a position that is not finite");

  message = goodMessage();
  message.pose.pose.orientation.w = 0.0;
  message.pose.pose.orientation.z = 0.0;
  EXPECT_EQ(reasonFor(message), "an orientation of norm 0");

  message = goodMessage();
  message.pose.pose.orientation.w = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reasonFor(message), "an orientation of norm nan");

  message = goodMessage();
  message.pose.covariance[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reasonFor(message), "a covariance that is not finite");

  message = goodMessage();
  message.pose.covariance[7] = -1.0;
  EXPECT_EQ(reasonFor(message), "a covariance that is not symmetric and positive");
}

}  // namespace
}  // namespace sightline::bridge
