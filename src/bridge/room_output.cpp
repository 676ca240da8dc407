#include "sightline/bridge/room_output.h"

#include <cmath>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/room_markers.h"
#include "sightline/bridge/room_messages.h"
#include "sightline/config/error.h"
#include "sightline/world/occupancy.h"

namespace sightline::bridge {

void RoomOutputConfig::visit(config::FieldVisitor& visitor) {
  visitor.flag("publish_tf", publish_tf, "broadcast map_frame to odom_frame");
  visitor.number(
      "transform_tolerance", transform_tolerance,
      {"s",
       {0.0, 10.0},
       "the broadcast is dated this much after the scan, so that it serves until the next one"});
  visitor.number("transform_rate", transform_rate,
                 {"Hz",
                  {0.0, 1000.0},
                  "rate at which map_frame to odom_frame is sent again between scans; 0: never"});
}

RoomOutput::RoomOutput(Output& output, const RoomOutputConfig& config,
                       const pipeline::Frames& frames, const pipeline::RoomsConfig& rooms,
                       const world::RoomMap& map)
    : config_(config),
      frames_(frames),
      map_(map),
      map_resolution_(rooms.map_resolution),
      wall_sigma_(rooms.tracker.wall.position_sigma),
      pose_(output.open<geometry_msgs::PoseWithCovarianceStamped>("pose")),
      status_port_(output.open<TrackerStatus>("tracker_status")),
      transforms_(output.openTransforms()),
      map_port_(output.open<nav_msgs::OccupancyGrid>("map", /*latched=*/true)) {
  if (output.isBag()) return;
  markers_ = output.open<visualization_msgs::MarkerArray>("room_markers");
  if (config_.publish_tf) writeFrameOfRooms(output);
  writeMap();
}

void RoomOutput::writeFrameOfRooms(Output& output) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {
      toTransformMessage(frames_.map, frames_.map + "_rooms", /*stamp=*/0, geometry::Pose2())};
  static_transforms_ = output.openStaticTransforms();
  static_transforms_.write(transforms);
}

void RoomOutput::drawAwaited() {
  if (has_pose_ || !markers_.is_wanted || !markers_.is_wanted()) return;
  const char* text = scans_ == 0
                         ? "no scan was used yet:\nsee the terminal, or /diagnostics"
                         : "no pose yet:\n2D Pose Estimate,\nor drive 2 m,\nor turn by 180 degrees";
  markers_.write(awaitingMarkers(map_, text, frames_.map));
}

// Into a bag with the first scan, whose time it is given.
void RoomOutput::writeMap() {
  if (map_is_written_) return;
  map_port_.write(toGridMessage(world::drawRooms(map_, map_resolution_), frames_.map));
  map_is_written_ = true;
}

std::string RoomOutput::write(const pipeline::Estimates& estimates, bool has_pose) {
  writeMap();
  ++scans_;
  has_pose_ = has_pose;
  if (!estimates.rooms) return writeNone(estimates, has_pose);
  writePose(estimates);
  return "";
}

void RoomOutput::writePose(const pipeline::Estimates& estimates) {
  const tracking::TrackerUpdate& update = *estimates.rooms;
  ++poses_;
  wall_report_.add(update, map_);
  odometry_scale_ = update.odometry_scale;
  if (update.state == tracking::TrackerState::kLost) ++lost_;
  pose_.write(toPoseMessage(update, frames_.map));
  status_ = toStatusMessage(update, map_, frames_.map);
  status_port_.write(status_);
  if (config_.publish_tf) {
    auto T_map_odom = toMapOdom(update, frames_.map, frames_.odom);
    T_map_odom.header.stamp += ros::Duration(config_.transform_tolerance);
    writeTransform(T_map_odom);
  }
  if (markers_.is_wanted && markers_.is_wanted()) {
    markers_.write(roomMarkers(update, map_, estimates.located.scan,
                               *estimates.located.T_base_sensor, frames_.map));
  }
}

// One transform for each time: two scanners may have the same stamps, and tf takes the first alone.
void RoomOutput::writeTransform(geometry_msgs::TransformStamped T_map_odom) {
  const bool is_sent =
      !T_map_odom_.header.frame_id.empty() && T_map_odom_.header.stamp == T_map_odom.header.stamp;
  if (is_sent) return;
  T_map_odom_ = std::move(T_map_odom);
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {T_map_odom_};
  transforms_.write(transforms);
}

void RoomOutput::resend(const ros::Time& now) {
  const ros::Time stamp = now + ros::Duration(config_.transform_tolerance);
  if (T_map_odom_.header.frame_id.empty() || stamp <= T_map_odom_.header.stamp) return;
  auto T_map_odom = T_map_odom_;
  T_map_odom.header.stamp = stamp;
  writeTransform(std::move(T_map_odom));
}

void RoomOutput::renewMap() {
  map_is_written_ = false;
  wall_report_.clear();
  writeMap();
}

// One status for one scan, also while there is no pose yet.
std::string RoomOutput::writeNone(const pipeline::Estimates& estimates, bool has_pose) {
  const std::string& no_odometry = estimates.located.no_odometry;
  const std::string reason = !no_odometry.empty() ? no_odometry
                             : has_pose           ? "older than the last scan used"
                                                  : "no pose yet";
  ++without_pose_[reason];
  if (has_pose) return reason;
  status_ = TrackerStatus();
  status_.header = headerOf(estimates.located.scan.stamp, frames_.map);
  status_port_.write(status_);
  return reason;
}

std::vector<std::string> RoomOutput::summary() const {
  std::vector<std::string> lines{fmt::format(
      "rooms: {} of {} scans have a pose, {} of them while lost", poses_, scans_, lost_)};
  for (const auto& [reason, count] : without_pose_) {
    lines.push_back(fmt::format("rooms: {} scans left out: {}", count, reason));
  }
  for (std::string& line : suspectWalls()) lines.push_back(std::move(line));
  return lines;
}

// Walls that were seen often and stand elsewhere by more than three times what the map is believed
// to be off by.
std::vector<std::string> RoomOutput::suspectWalls() const {
  constexpr std::size_t kOften = 20;
  std::vector<std::string> lines;
  for (const tracking::WallUse& use : wall_report_.uses(map_)) {
    if (use.fitted < kOften || !use.isSuspect(3.0 * wall_sigma_)) continue;
    lines.push_back(fmt::format(
        "rooms: wall {} of {} is {:.0f} mm {} than the map says, and corrected the pose in {} of "
        "{} scans that saw it",
        use.wall, use.room, 1e3 * std::abs(use.mean_offset),
        use.mean_offset > 0.0 ? "further in" : "further out", use.used, use.fitted));
  }
  return lines;
}

void RoomOutput::writeWalls(const std::string& path) const {
  std::ofstream file(path);
  file << "room,wall,scans,used,offset_m,offset_std_m\n";
  for (const tracking::WallUse& use : wall_report_.uses(map_)) {
    file << fmt::format("{},{},{},{},{:.4f},{:.4f}\n", use.room, use.wall, use.fitted, use.used,
                        use.mean_offset, use.std_offset);
  }
  file.close();
  if (!file) throw config::Error(path, 0, "", "cannot be written");
}

}  // namespace sightline::bridge
