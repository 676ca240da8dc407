#include "sightline/bridge/pose_conversion.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sightline/bridge/message_header.h"
#include "sightline/config/field_visitor.h"

namespace sightline::bridge {

namespace {

constexpr std::array<int, 3> kPlanar{0, 1, 5};  // x, y and yaw among the six

Eigen::Matrix3d rotationOf(const geometry_msgs::Quaternion& q) {
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
}

geometry_msgs::TransformStamped transformMessage(const std::string& parent,
                                                 const std::string& child, std::int64_t stamp,
                                                 const geometry_msgs::Transform& transform) {
  geometry_msgs::TransformStamped message;
  message.header = headerOf(stamp, parent);
  message.child_frame_id = child;
  message.transform = transform;
  return message;
}

double yawOf(const geometry_msgs::Quaternion& q) {
  const Eigen::Matrix3d rotation = rotationOf(q);
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

}  // namespace

geometry::Pose2 toPose2(const geometry_msgs::Pose& pose) {
  return {pose.position.x, pose.position.y, yawOf(pose.orientation)};
}

geometry::Pose2 toPose2(const geometry_msgs::Transform& transform) {
  return {transform.translation.x, transform.translation.y, yawOf(transform.rotation)};
}

geometry_msgs::Quaternion toQuaternion(double yaw) {
  geometry_msgs::Quaternion quaternion;
  quaternion.z = std::sin(0.5 * yaw);
  quaternion.w = std::cos(0.5 * yaw);
  return quaternion;
}

geometry_msgs::Pose toPose(const geometry::Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x();
  message.position.y = pose.y();
  message.orientation = toQuaternion(pose.theta());
  return message;
}

geometry_msgs::Transform toTransform(const geometry::Pose2& pose) {
  geometry_msgs::Transform message;
  message.translation.x = pose.x();
  message.translation.y = pose.y();
  message.rotation = toQuaternion(pose.theta());
  return message;
}

geometry_msgs::TransformStamped toTransformMessage(const std::string& parent,
                                                   const std::string& child, std::int64_t stamp,
                                                   const geometry::Pose2& T_parent_child) {
  return transformMessage(parent, child, stamp, toTransform(T_parent_child));
}

geometry_msgs::TransformStamped toTransformMessage(const std::string& parent,
                                                   const std::string& child, std::int64_t stamp,
                                                   const Eigen::Isometry3d& T_parent_child) {
  const Eigen::Quaterniond rotation(T_parent_child.linear());
  geometry_msgs::Transform transform;
  transform.translation.x = T_parent_child.translation().x();
  transform.translation.y = T_parent_child.translation().y();
  transform.translation.z = T_parent_child.translation().z();
  transform.rotation.x = rotation.x();
  transform.rotation.y = rotation.y();
  transform.rotation.z = rotation.z();
  transform.rotation.w = rotation.w();
  return transformMessage(parent, child, stamp, transform);
}

boost::array<double, 36> toCovariance6(const Eigen::Matrix3d& covariance) {
  boost::array<double, 36> result;
  result.fill(0.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result[static_cast<std::size_t>(6 * kPlanar[row] + kPlanar[column])] =
          covariance(row, column);
    }
  }
  return result;
}

Eigen::Matrix3d toCovariance3(const boost::array<double, 36>& covariance) {
  Eigen::Matrix3d result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result(row, column) =
          covariance[static_cast<std::size_t>(6 * kPlanar[row] + kPlanar[column])];
    }
  }
  return result;
}

Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  const auto& t = transform.translation;
  result.linear() = rotationOf(transform.rotation);
  result.translation() = Eigen::Vector3d(t.x, t.y, t.z);
  return result;
}

std::string faultOfPose(const Eigen::Vector3d& position, const geometry_msgs::Quaternion& q) {
  // What is further off than this was never a rotation.
  constexpr double kRounding = 0.1;
  if (!position.allFinite()) return "a position that is not finite";
  if (position.cwiseAbs().maxCoeff() > config::kCoordinate.max) {
    return fmt::format("a position of {:.3g} m", position.cwiseAbs().maxCoeff());
  }
  const double norm = Eigen::Vector4d(q.x, q.y, q.z, q.w).norm();
  if (std::abs(norm - 1.0) < kRounding) return "";
  return fmt::format("an orientation of norm {:.3g}", norm);
}

geometry_msgs::Quaternion normalized(const geometry_msgs::Quaternion& q) {
  const double norm = Eigen::Vector4d(q.x, q.y, q.z, q.w).norm();
  geometry_msgs::Quaternion result;
  result.x = q.x / norm;
  result.y = q.y / norm;
  result.z = q.z / norm;
  result.w = q.w / norm;
  return result;
}

std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace sightline::bridge
