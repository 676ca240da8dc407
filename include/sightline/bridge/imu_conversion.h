#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Geometry>

#include <sensor_msgs/Imu.h>

#include "sightline/pipeline/imu_history.h"

namespace sightline::bridge {

/// Reads a message of an inertial sensor as a reading of the base on which it sits. Without an
/// orientation (a first covariance of -1, or a quaternion of zeros, as sensor_msgs/Imu has it)
/// there is no attitude, and the turn rate is the one about the base's z axis. Throws BadMessage
/// with the reason: a stamp of zero, numbers that are not finite, no angular velocity.
pipeline::ImuReading readImu(const sensor_msgs::Imu& message, const Eigen::Quaterniond& R_base_imu);

/// The reading of a sensor that sits straight on the base: its attitude, and the turn rate of its
/// heading [rad/s]; accelerations are not known.
sensor_msgs::Imu toImuMessage(std::int64_t stamp, const std::string& frame,
                              const geometry::Attitude& attitude, double turn_rate);

}  // namespace sightline::bridge
