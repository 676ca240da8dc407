#include "sightline/pipeline/offline_config.h"

#include <fmt/format.h>

namespace sightline::pipeline {

namespace {

using config::Node;

std::vector<std::string> readTopics(const Node& node) {
  std::vector<std::string> topics;
  for (const Node& item : node.items()) topics.push_back(item.text());
  if (topics.empty()) node.fail("no topics");
  return topics;
}

template <class Config>
void readGroup(const Node& document, const char* key, Config& config) {
  if (!document.has(key)) return;
  const Node group = document.at(key);
  if (!group.isMap()) group.fail("expected a map");
  config::read(group, config);
}

std::map<std::string, geometry::Pose2> readMountings(const Node& node) {
  std::map<std::string, geometry::Pose2> mountings;
  for (const auto& [frame, pose] : node.entries()) {
    const std::vector<double> numbers = pose.numbers(3);
    mountings[frame] = {numbers[0], numbers[1], numbers[2]};
  }
  return mountings;
}

RoomsConfig readRooms(const Node& node) {
  RoomsConfig rooms;
  config::read(node, rooms);
  rooms.map = node.at("map").path();
  rooms.initial_pose = node.at("initial_pose").numbers(3);
  if (node.has("initial_sigma")) rooms.initial_sigma = node.at("initial_sigma").numbers(2);
  return rooms;
}

// The file of the carrier, which is one of parameters of the node too, and what is set beside it.
std::optional<ScanOdometryConfig> readOdometry(const Node& document) {
  if (!document.has("carrier") && !document.has("odometry")) return std::nullopt;
  ScanOdometryConfig odometry;
  if (document.has("carrier")) {
    const Node carrier = Node::readFile(document.at("carrier").path());
    carrier.allowOnly({"odometry"});
    readGroup(carrier, "odometry", odometry);
  }
  readGroup(document, "odometry", odometry);
  return odometry;
}

}  // namespace

void Frames::visit(config::FieldVisitor& visitor) {
  visitor.text("map", map, "frame of the rooms");
  visitor.text("odom", odom, "frame of the odometry");
  visitor.text("base", base, "frame of the robot");
}

void RoomsConfig::visit(config::FieldVisitor& visitor) {
  visitor.text("map", map, "path of the rooms file, relative to the file that names it");
  visitor.numbers("initial_pose", initial_pose,
                  {"m, m, rad", {}, "x, y and yaw of the robot in the map at the first scan"});
  visitor.numbers("initial_sigma", initial_sigma,
                  {"m, rad", config::kNotNegative,
                   "standard deviations of position and heading of the start pose"});
  visitor.group("tracker", tracker);
}

OfflineConfig OfflineConfig::readFile(const std::string& path) {
  const Node document = Node::readFile(path);
  document.allowOnly(
      {"scans", "frames", "mountings", "noise", "lines", "rooms", "carrier", "odometry"});
  OfflineConfig config;
  if (document.has("scans")) config.scans = readTopics(document.at("scans"));
  readGroup(document, "frames", config.frames);
  if (document.has("mountings")) config.mountings = readMountings(document.at("mountings"));
  readGroup(document, "noise", config.noise);
  readGroup(document, "lines", config.lines);
  if (document.has("rooms")) config.rooms = readRooms(document.at("rooms"));
  config.odometry = readOdometry(document);
  return config;
}

}  // namespace sightline::pipeline
