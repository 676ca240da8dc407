#pragma once

#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <std_srvs/Trigger.h>

#include "sightline/InflateUncertainty.h"
#include "sightline/LoadRooms.h"
#include "sightline/RoomTrackerConfig.h"
#include "sightline/SetRoom.h"
#include "sightline/bridge/room_output.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::nodes {

/// Ways for people and programs to talk to a running room tracker: initialpose, services, settings,
/// diagnostics.
class RoomControls {
 public:
  /// All of them have to live as long.
  RoomControls(ros::NodeHandle node, ros::NodeHandle private_node,
               const pipeline::RoomsConfig& config, const std::string& map_frame,
               tracking::RoomTracker& tracker, bridge::RoomOutput& output,
               diagnostic_updater::Updater& updater);

 private:
  void onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message);
  bool onSetRoom(SetRoom::Request& request, SetRoom::Response& response);
  bool onLoadRooms(LoadRooms::Request& request, LoadRooms::Response& response);
  bool onRelocalise(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onInflate(InflateUncertainty::Request& request, InflateUncertainty::Response& response);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  pipeline::RoomsConfig config_;
  std::string map_frame_;
  tracking::RoomTracker& tracker_;
  bridge::RoomOutput& output_;
  boost::recursive_mutex reconfigure_mutex_;
  dynamic_reconfigure::Server<RoomTrackerConfig> reconfigure_;
  ros::Subscriber initial_pose_subscriber_;
  ros::ServiceServer set_room_server_;
  ros::ServiceServer load_rooms_server_;
  ros::ServiceServer relocalise_server_;
  ros::ServiceServer inflate_server_;
  ros::SteadyTimer awaited_timer_;  // draws what is awaited, also where no scan comes
};

}  // namespace sightline::nodes
