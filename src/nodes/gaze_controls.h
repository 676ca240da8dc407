#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PointStamped.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <sightline/Fixate.h>
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/gaze/gaze_control.h"

namespace sightline::nodes {

/// Ways for people and programs to say where a head looks: services, a click in rviz; and
/// diagnostics.
class GazeControls {
 public:
  /// All of them have to live as long.
  GazeControls(ros::NodeHandle node, ros::NodeHandle private_node, const std::string& odom_frame,
               const pipeline::Transforms& transforms, gaze::GazeControl& gaze,
               diagnostic_updater::Updater& updater);

 private:
  using Trigger = std_srvs::Trigger;
  using Wish = void (gaze::GazeControl::*)();

  ros::ServiceServer advertise(ros::NodeHandle& private_node, const std::string& name, Wish wish);
  bool onFixate(Fixate::Request& request, Fixate::Response& response);
  gaze::Fixated fixate(const Fixate::Request& request);
  gaze::Fixated fixateAt(const geometry_msgs::PointStamped& point);
  void onClick(const geometry_msgs::PointStamped& point);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::string odom_frame_;
  const pipeline::Transforms& transforms_;
  gaze::GazeControl& gaze_;
  bridge::InputMonitor clicks_;
  ros::ServiceServer fixate_server_;
  ros::ServiceServer hold_server_;
  ros::ServiceServer sweep_server_;
  ros::ServiceServer inform_server_;
  ros::Subscriber click_subscriber_;
};

}  // namespace sightline::nodes
