#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/buffer.h>

#include "sightline/bridge/input_monitor.h"
#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/imu_history.h"
#include "sightline/pipeline/scan_odometry.h"

namespace sightline::bridge {

/// What wheels and an inertial sensor say of the motion, from the topics odom and imu: either, both
/// or none may be there. A message that cannot be used is dropped, counted and told.
class MotionInputs {
 public:
  struct Settings {
    std::string base_frame;
    bool use_wheels = true;
    bool use_imu = true;
  };

  /// Updater and transforms have to live as long.
  MotionInputs(ros::NodeHandle node, Settings settings, const tf2_ros::Buffer& transforms,
               diagnostic_updater::Updater& updater);

  /// Whether an input that has been coming has not come as far as this time [ns] yet.
  bool isBehind(std::int64_t stamp) const;
  /// All that is known of a scan, whose motion during the sweep is filled in where the wheels know
  /// it. `before` is the stamp of the scan before [ns].
  pipeline::OdometryAids aidsFor(scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                                 std::optional<std::int64_t> before) const;

 private:
  struct Input {
    ros::Subscriber subscriber;
    std::unique_ptr<InputMonitor> monitor;  // from the first message on
  };

  void onWheels(const nav_msgs::Odometry& message);
  void onImu(const sensor_msgs::Imu& message);
  Eigen::Quaterniond rotationToBase(const std::string& frame) const;
  InputMonitor& monitorOf(Input& input);

  Settings settings_;
  const tf2_ros::Buffer& transforms_;
  diagnostic_updater::Updater& updater_;
  motion::PoseHistory wheels_;
  pipeline::ImuHistory imu_;
  Input wheels_input_;
  Input imu_input_;
};

}  // namespace sightline::bridge
