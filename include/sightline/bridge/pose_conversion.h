#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Geometry>

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <boost/array.hpp>

#include "sightline/geometry/pose2.h"

namespace sightline::bridge {

/// Yaw and position of a pose or transform that lies in the plane; what tilt it has is left out.
geometry::Pose2 toPose2(const geometry_msgs::Pose& pose);
geometry::Pose2 toPose2(const geometry_msgs::Transform& transform);

geometry_msgs::Pose toPose(const geometry::Pose2& pose);
geometry_msgs::Transform toTransform(const geometry::Pose2& pose);
geometry_msgs::Quaternion toQuaternion(double yaw);

/// Message to tf: the pose of the frame `child` in `parent` at a time [ns].
geometry_msgs::TransformStamped toTransformMessage(const std::string& parent,
                                                   const std::string& child, std::int64_t stamp,
                                                   const geometry::Pose2& T_parent_child);
geometry_msgs::TransformStamped toTransformMessage(const std::string& parent,
                                                   const std::string& child, std::int64_t stamp,
                                                   const Eigen::Isometry3d& T_parent_child);

/// Covariance of (x, y, yaw) in the 6x6 of ROS, row-major at [0] [7] [35], cross terms filled, the
/// rest zero.
boost::array<double, 36> toCovariance6(const Eigen::Matrix3d& covariance);
Eigen::Matrix3d toCovariance3(const boost::array<double, 36>& covariance);

Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform);
/// Reason for which numbers are no pose of anything on a floor: they are not finite, farther than
/// 100 km away, or no rotation. Empty where they may be one.
std::string faultOfPose(const Eigen::Vector3d& position, const geometry_msgs::Quaternion& q);
/// The rotation that was meant by a quaternion which is one but for its rounding.
geometry_msgs::Quaternion normalized(const geometry_msgs::Quaternion& q);
/// A frame's name without the leading slash that tf of old wrote.
std::string withoutSlash(const std::string& frame);

}  // namespace sightline::bridge
