#include "sightline/bridge/room_messages.h"

#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {

geometry_msgs::PoseWithCovarianceStamped toPoseMessage(const tracking::TrackerUpdate& update,
                                                       const std::string& map_frame) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = headerOf(update.stamp, map_frame);
  message.pose.pose = toPose(update.pose.mean);
  message.pose.covariance = toCovariance6(update.pose.covariance);
  return message;
}

namespace {

WallStatus toWallStatus(const tracking::WallUpdate& wall, const world::RoomMap& map) {
  WallStatus message;
  message.room = map.rooms()[wall.room].name;
  message.wall = static_cast<std::uint32_t>(wall.wall);
  message.gate_opening = wall.gate.opening;
  message.gate_angle = wall.gate.angle;
  message.beams_in_gate = static_cast<std::uint32_t>(wall.beams_in_gate);
  message.beams_accepted = static_cast<std::uint32_t>(wall.acceptedBeams());
  message.accepted = wall.accepted();
  if (!wall.innovation) return message;
  message.innovation[0] = wall.innovation->value[0];
  message.innovation[1] = wall.innovation->value[1];
  message.nis = wall.innovation->nis;
  return message;
}

RivalPose toRivalMessage(const tracking::RivalPose& rival, const world::RoomMap& map) {
  RivalPose message;
  message.pose.pose = toPose(rival.pose.mean);
  message.pose.covariance = toCovariance6(rival.pose.covariance);
  message.room = map.rooms()[rival.room].name;
  message.probability = rival.probability;
  return message;
}

}  // namespace

TrackerStatus toStatusMessage(const tracking::TrackerUpdate& update, const world::RoomMap& map,
                              const std::string& map_frame) {
  TrackerStatus message;
  message.header = headerOf(update.stamp, map_frame);
  message.state = static_cast<std::uint8_t>(update.state);
  message.quality = update.quality;
  message.room = update.room;
  message.covariance_valid = update.covariance_valid;
  for (const auto& wall : update.walls) message.walls.push_back(toWallStatus(wall, map));
  for (const auto& rival : update.rivals) message.rivals.push_back(toRivalMessage(rival, map));
  return message;
}

geometry_msgs::TransformStamped toMapOdom(const tracking::TrackerUpdate& update,
                                          const std::string& map_frame,
                                          const std::string& odom_frame) {
  return toTransformMessage(map_frame, odom_frame, update.stamp, update.T_map_odom);
}

nav_msgs::OccupancyGrid toGridMessage(const world::Occupancy& grid, const std::string& map_frame) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = map_frame;
  message.info.resolution = static_cast<float>(grid.resolution);
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.origin.position.x = grid.origin.x();
  message.info.origin.position.y = grid.origin.y();
  message.info.origin.orientation.w = 1.0;
  message.data.assign(grid.cells.begin(), grid.cells.end());
  return message;
}

}  // namespace sightline::bridge
