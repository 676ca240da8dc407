#include "sightline/bridge/imu_conversion.h"

#include <cmath>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/message_header.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

constexpr double kFastestTurn = 100.0;  // [rad/s]

bool hasOrientation(const sensor_msgs::Imu& message) {
  const auto& q = message.orientation;
  return message.orientation_covariance[0] >= 0.0 &&
         !(Eigen::Vector4d(q.x, q.y, q.z, q.w).norm() < 0.5);
}

void checkImu(const sensor_msgs::Imu& message) {
  const auto& w = message.angular_velocity;
  const auto& q = message.orientation;
  if (message.header.stamp.isZero()) throw BadMessage("a stamp of zero");
  if (message.angular_velocity_covariance[0] < 0.0) {
    throw BadMessage("no angular velocity");
  }
  if (!std::isfinite(w.x + w.y + w.z)) {
    throw BadMessage("an angular velocity that is not finite");
  }
  if (Eigen::Vector3d(w.x, w.y, w.z).norm() > kFastestTurn) {
    throw BadMessage("an angular velocity that nothing on a floor has");
  }
  if (hasOrientation(message) && !std::isfinite(q.x + q.y + q.z + q.w)) {
    throw BadMessage("an orientation that is not finite");
  }
}

}  // namespace

pipeline::ImuReading readImu(const sensor_msgs::Imu& message,
                             const Eigen::Quaterniond& R_base_imu) {
  checkImu(message);
  const auto& w = message.angular_velocity;
  const Eigen::Vector3d rate_base = R_base_imu * Eigen::Vector3d(w.x, w.y, w.z);
  pipeline::ImuReading reading;
  reading.stamp = nanoseconds(message.header.stamp);
  reading.turn_rate = rate_base.z();
  if (!hasOrientation(message)) return reading;
  const auto& q = message.orientation;
  const Eigen::Quaterniond R_world_imu(q.w, q.x, q.y, q.z);
  reading.attitude = geometry::Attitude::of(
      (R_world_imu.normalized() * R_base_imu.conjugate()).toRotationMatrix());
  // The heading of a leaning base turns about the vertical.
  const auto& [roll, pitch] = *reading.attitude;
  if (std::cos(pitch) > 0.1) {
    reading.turn_rate =
        (rate_base.y() * std::sin(roll) + rate_base.z() * std::cos(roll)) / std::cos(pitch);
  }
  return reading;
}

sensor_msgs::Imu toImuMessage(std::int64_t stamp, const std::string& frame,
                              const geometry::Attitude& attitude, double turn_rate) {
  const Eigen::Matrix3d R_level_imu = attitude.rotation();
  const Eigen::Quaterniond orientation(R_level_imu);
  const Eigen::Vector3d rate = R_level_imu.transpose() * Eigen::Vector3d(0.0, 0.0, turn_rate);
  sensor_msgs::Imu message;
  message.header = headerOf(stamp, frame);
  message.orientation.x = orientation.x();
  message.orientation.y = orientation.y();
  message.orientation.z = orientation.z();
  message.orientation.w = orientation.w();
  message.angular_velocity.x = rate.x();
  message.angular_velocity.y = rate.y();
  message.angular_velocity.z = rate.z();
  message.linear_acceleration_covariance[0] = -1.0;
  return message;
}

}  // namespace sightline::bridge
