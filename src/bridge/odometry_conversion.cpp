#include "sightline/bridge/odometry_conversion.h"

#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {

nav_msgs::Odometry toOdometryMessage(const OdometryHeader& header,
                                     const geometry::UncertainPose2& pose,
                                     const geometry::UncertainTwist2& twist) {
  nav_msgs::Odometry message;
  message.header = headerOf(header.stamp, header.frame);
  message.child_frame_id = header.child_frame;
  message.pose.pose = toPose(pose.mean);
  message.pose.covariance = toCovariance6(pose.covariance);
  message.twist.twist.linear.x = twist.mean[0];
  message.twist.twist.linear.y = twist.mean[1];
  message.twist.twist.angular.z = twist.mean[2];
  message.twist.covariance = toCovariance6(twist.covariance);
  return message;
}

}  // namespace sightline::bridge
