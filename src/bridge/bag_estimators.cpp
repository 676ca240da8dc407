#include "sightline/bridge/bag_estimators.h"

#include <algorithm>

#include <fmt/format.h>
#include <ros/message_traits.h>
#include <tf2_msgs/TFMessage.h>
#include <boost/make_shared.hpp>

#include "sightline/bridge/initial_pose.h"
#include "sightline/bridge/laser_odometry_messages.h"
#include "sightline/bridge/line_messages.h"
#include "sightline/bridge/room_messages.h"
#include "sightline/bridge/time.h"
#include "sightline/world/occupancy.h"

namespace sightline::bridge {

namespace {

constexpr double kMapResolution = 0.05;  // m

const pipeline::RoomsConfig& roomsOf(const pipeline::OfflineConfig& config) {
  if (!config.rooms) throw config::Error("", 0, "rooms", "the settings do not say which");
  return *config.rooms;
}

// A connection whose last message a player repeats to late subscribers.
template <class Message>
boost::shared_ptr<ros::M_string> latchedHeader() {
  namespace traits = ros::message_traits;
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = traits::datatype<Message>();
  (*header)["md5sum"] = traits::md5sum<Message>();
  (*header)["message_definition"] = traits::definition<Message>();
  (*header)["latching"] = "1";
  return header;
}

double ratio(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(whole, 1));
}

}  // namespace

BagLines::BagLines(const pipeline::OfflineConfig& config, rosbag::Bag& out)
    : extractor_(config.lines), out_(out) {}

void BagLines::process(const LocatedScan& located, const ros::Time& now) {
  const auto& segments = extractor_.extract(located.scan);
  ++scans_;
  segments_ += segments.size();
  arcs_ += extractor_.arcs().size();
  out_.write("/lines", now, toMessage(segments, extractor_.arcs(), located.scan));
}

std::vector<std::string> BagLines::summary() const {
  return {fmt::format("lines: {:.1f} segments and {:.1f} arcs a scan in {} scans",
                      ratio(segments_, scans_), ratio(arcs_, scans_), scans_)};
}

BagRooms::BagRooms(const pipeline::OfflineConfig& config, rosbag::Bag& out,
                   const std::string& trajectory)
    : frames_(config.frames),
      tracker_(roomsOf(config).tracker, world::RoomMap::readFile(roomsOf(config).map)),
      out_(out),
      trajectory_(trajectory) {
  tracker_.setPose(startPose(config.rooms->initial_pose, config.rooms->initial_sigma));
}

void BagRooms::process(const LocatedScan& located, const ros::Time& now) {
  if (scans_++ == 0) writeMap(now);
  if (!located.T_base_sensor) {
    ++without_pose_[fmt::format("no transform to {} at its time", frames_.base)];
    return;
  }
  if (!located.T_odom_base) {
    ++without_pose_[fmt::format("no transform from {} to {} at its time", frames_.base,
                                frames_.odom)];
    return;
  }
  const auto update = tracker_.update(located.scan, *located.T_odom_base, *located.T_base_sensor);
  if (update) {
    write(*update, now);
  } else {
    ++without_pose_["older than the scan before it"];
  }
}

void BagRooms::writeMap(const ros::Time& now) {
  const auto grid = toGridMessage(world::drawRooms(tracker_.map(), kMapResolution), frames_.map);
  out_.write("/map", now, grid, latchedHeader<nav_msgs::OccupancyGrid>());
}

void BagRooms::write(const tracking::TrackerUpdate& update, const ros::Time& now) {
  ++poses_;
  if (update.state == tracking::TrackerState::kLost) ++lost_;
  trajectory_.add(update.stamp, update.pose.mean);
  out_.write("/pose", now, toPoseMessage(update, frames_.map));
  out_.write("/tracker_status", now, toStatusMessage(update, tracker_.map(), frames_.map));
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {toMapOdom(update, frames_.map, frames_.odom)};
  out_.write("/tf", now, transforms);
}

std::vector<std::string> BagRooms::summary() const {
  std::vector<std::string> lines{fmt::format(
      "rooms: {} of {} scans have a pose, {} of them while lost", poses_, scans_, lost_)};
  for (const auto& [reason, count] : without_pose_) {
    lines.push_back(fmt::format("rooms: {} scans left out: {}", count, reason));
  }
  return lines;
}

BagOdometry::BagOdometry(const pipeline::OfflineConfig& config, rosbag::Bag& out,
                         const std::string& trajectory)
    : frames_(config.frames),
      odometry_(config.odometry.value_or(pipeline::ScanOdometryConfig())),
      out_(out),
      trajectory_(trajectory) {}

void BagOdometry::process(const LocatedScan& located, const ros::Time& now) {
  ++scans_;
  pipeline::OdometryAids aids;
  aids.T_odom_base = located.T_odom_base;
  const auto update =
      odometry_.update(located.scan, located.T_base_sensor.value_or(geometry::Pose2()), aids);
  if (!update) return;
  ++poses_;
  if (update->isFlagged()) ++flagged_;
  if (located.T_odom_base) ++with_wheels_;
  trajectory_.add(update->stamp, update->pose.mean);
  out_.write("/laser_odom", now, toLaserOdometryMessage(*update, frames_.odom, frames_.base));
}

std::vector<std::string> BagOdometry::summary() const {
  std::vector<std::string> lines{fmt::format(
      "odometry: {} of {} scans have a pose, {} of them flagged, {} with the wheels as prior",
      poses_, scans_, flagged_, with_wheels_)};
  if (scans_ > poses_) {
    lines.push_back(
        fmt::format("odometry: {} scans left out: older than the scan before it", scans_ - poses_));
  }
  return lines;
}

}  // namespace sightline::bridge
