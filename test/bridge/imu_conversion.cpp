#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/bad_message.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "sightline/geometry/angle.h"

namespace sightline::bridge {
namespace {

using geometry::Attitude;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
const Eigen::Quaterniond kStraight = Eigen::Quaterniond::Identity();

sensor_msgs::Imu leaning() {
  return toImuMessage(5'000'000'000, "imu", {0.1, -0.2}, 0.7);
}

TEST(Imu, ComesBackAsItWasSent) {
  const auto reading = readImu(leaning(), kStraight);
  EXPECT_EQ(reading.stamp, 5'000'000'000);
  ASSERT_TRUE(reading.attitude.has_value());
  EXPECT_NEAR(reading.attitude->roll, 0.1, 1e-12);
  EXPECT_NEAR(reading.attitude->pitch, -0.2, 1e-12);
  EXPECT_NEAR(reading.turn_rate, 0.7, 1e-12) << "about the vertical";
}

TEST(Imu, ItsHeadingDoesNotMatter) {
  auto message = leaning();
  const Eigen::Quaterniond turned = Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) *
                                    Eigen::Quaterniond(Attitude{0.1, -0.2}.rotation());
  message.orientation.x = turned.x();
  message.orientation.y = turned.y();
  message.orientation.z = turned.z();
  message.orientation.w = turned.w();
  EXPECT_NEAR(readImu(message, kStraight).attitude->pitch, -0.2, 1e-12);
}

TEST(Imu, HowItIsMountedIsTakenOut) {
  // On its head, and turned: what it measures is of the base all the same.
  const Eigen::Quaterniond R_base_imu(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(geometry::kPi, Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond R_level_base(Attitude{0.05, 0.15}.rotation());
  const Eigen::Quaterniond R_level_imu = R_level_base * R_base_imu;
  const Eigen::Vector3d rate_imu = R_level_imu.conjugate() * Eigen::Vector3d(0.0, 0.0, -0.4);
  sensor_msgs::Imu message = leaning();
  message.orientation.x = R_level_imu.x();
  message.orientation.y = R_level_imu.y();
  message.orientation.z = R_level_imu.z();
  message.orientation.w = R_level_imu.w();
  message.angular_velocity.x = rate_imu.x();
  message.angular_velocity.y = rate_imu.y();
  message.angular_velocity.z = rate_imu.z();
  const auto reading = readImu(message, R_base_imu);
  EXPECT_NEAR(reading.attitude->roll, 0.05, 1e-12);
  EXPECT_NEAR(reading.attitude->pitch, 0.15, 1e-12);
  EXPECT_NEAR(reading.turn_rate, -0.4, 1e-12);
}

TEST(Imu, WithoutAnOrientationTheTurnRateStays) {
  auto message = leaning();
  message.orientation_covariance[0] = -1.0;
  EXPECT_FALSE(readImu(message, kStraight).attitude);
  EXPECT_EQ(readImu(message, kStraight).turn_rate, message.angular_velocity.z);
  message = leaning();
  message.orientation = geometry_msgs::Quaternion();
  EXPECT_FALSE(readImu(message, kStraight).attitude);
}

TEST(Imu, NonsenseIsRefused) {
  const auto expectRefusal = [](const sensor_msgs::Imu& message) {
    EXPECT_THROW(readImu(message, kStraight), BadMessage);
  };
  auto message = leaning();
  message.header.stamp = ros::Time();
  expectRefusal(message);
  message = leaning();
  message.angular_velocity.z = kNotANumber;
  expectRefusal(message);
  message = leaning();
  message.orientation.w = kNotANumber;
  expectRefusal(message);
  message = leaning();
  message.angular_velocity_covariance[0] = -1.0;
  expectRefusal(message);
}

}  // namespace
}  // namespace sightline::bridge
