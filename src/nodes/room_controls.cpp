#include "nodes/room_controls.h"

#include <cmath>

#include <ros/console.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/initial_pose.h"
#include "sightline/bridge/tracker_settings.h"

namespace sightline::nodes {

RoomControls::RoomControls(ros::NodeHandle node, ros::NodeHandle private_node,
                           const pipeline::RoomsConfig& config, const std::string& map_frame,
                           tracking::RoomTracker& tracker, bridge::RoomOutput& output,
                           diagnostic_updater::Updater& updater)
    : config_(config),
      map_frame_(map_frame),
      tracker_(tracker),
      output_(output),
      reconfigure_(reconfigure_mutex_, ros::NodeHandle(private_node, "tracker")) {
  updater.add("tracking", this, &RoomControls::report);
  initial_pose_subscriber_ = node.subscribe("initialpose", 1, &RoomControls::onInitialPose, this);
  set_room_server_ = private_node.advertiseService("set_room", &RoomControls::onSetRoom, this);
  load_rooms_server_ =
      private_node.advertiseService("load_rooms", &RoomControls::onLoadRooms, this);
  inflate_server_ =
      private_node.advertiseService("inflate_uncertainty", &RoomControls::onInflate, this);
  relocalise_server_ =
      private_node.advertiseService("relocalise", &RoomControls::onRelocalise, this);
  awaited_timer_ = node.createSteadyTimer(
      ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { output_.drawAwaited(); });
  reconfigure_.updateConfig(bridge::toReconfigure(config_.tracker));
  reconfigure_.setCallback([this](RoomTrackerConfig& settings, std::uint32_t) {
    bridge::applyReconfigure(settings, config_.tracker);
    tracker_.configure(config_.tracker);
  });
}

void RoomControls::onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  try {
    tracker_.setPose(bridge::readInitialPose(message, map_frame_, config_.initial_sigma));
    ROS_INFO("tracking starts at (%.2f, %.2f)", message.pose.pose.position.x,
             message.pose.pose.position.y);
  } catch (const bridge::BadMessage& fault) {
    ROS_ERROR("initialpose refused: %s", fault.what());
  }
}

bool RoomControls::onSetRoom(SetRoom::Request& request, SetRoom::Response& response) {
  response.success = tracker_.setRoom(request.room);
  if (!response.success) response.message = "no room is called '" + request.room + "'";
  return true;
}

bool RoomControls::onLoadRooms(LoadRooms::Request& request, LoadRooms::Response& response) {
  try {
    tracker_.replaceMap(world::RoomMap::readFile(request.path));
    output_.renewMap();
    response.success = true;
    ROS_INFO("rooms of %s", request.path.c_str());
  } catch (const config::Error& fault) {
    response.message = fault.what();
  }
  return true;
}

bool RoomControls::onRelocalise(std_srvs::Trigger::Request&,
                                std_srvs::Trigger::Response& response) {
  response.success = tracker_.relocalise();
  response.message = response.success ? "searching the map: drive 2 m or turn by 180 degrees"
                                      : "the method plain cannot search the map";
  return true;
}

bool RoomControls::onInflate(InflateUncertainty::Request& request,
                             InflateUncertainty::Response& response) {
  response.success = request.position >= 0.0 && request.heading >= 0.0 &&
                     std::isfinite(request.position) && std::isfinite(request.heading);
  if (response.success) {
    tracker_.inflate(request.position, request.heading);
  } else {
    response.message = "standard deviations have to be finite and not negative";
  }
  return true;
}

void RoomControls::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  switch (output_.status().state) {
    case TrackerStatus::TRACKING:
      status.summary(DiagnosticStatus::OK, "tracking");
      break;
    case TrackerStatus::DEGRADED:
      status.summary(DiagnosticStatus::WARN, "degraded: the pose is vague, or not certain yet");
      break;
    case TrackerStatus::LOST:
      status.summary(DiagnosticStatus::ERROR, "lost: the scans do not fit the room");
      break;
    default:
      status.summary(DiagnosticStatus::WARN,
                     "no pose yet: set initial_pose or send initialpose, or drive "
                     "2 m or turn by 180 degrees to be found");
  }
  status.add("room", output_.status().room);
  status.add("quality", output_.status().quality);
  status.add("poses held possible", tracker_.rivals().size());
  status.add("odometry scale", output_.odometryScale());
}

}  // namespace sightline::nodes
