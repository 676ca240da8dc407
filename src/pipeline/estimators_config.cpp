#include "sightline/pipeline/estimators_config.h"

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

// A document of which this struct knows some keys and others the rest.
template <class Config>
void readShared(const Node& document, Config& config) {
  config::read(document, config, config::UnknownKeys::kIgnore);
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

void readScans(const Node& document, InputConfig& input) {
  if (document.has("range_scans")) input.range_scans = readTopics(document.at("range_scans"));
  if (document.has("scans")) input.scans = readTopics(document.at("scans"));
}

// The file of the carrier, which is one of parameters of the nodes too, and what is set beside it.
void readCarrier(const Node& document, EstimatorsConfig& config) {
  if (document.has("carrier") || document.has("odometry")) config.odometry.emplace();
  if (document.has("carrier")) {
    const Node carrier = Node::readFile(document.at("carrier").path());
    carrier.allowOnly({"leans", "floor", "odometry"});
    readShared(carrier, config.input);
    readGroup(carrier, "odometry", *config.odometry);
  }
  if (document.has("odometry")) readGroup(document, "odometry", *config.odometry);
}

}  // namespace

void LinesConfig::visit(config::FieldVisitor& visitor) {
  visitor.choice("method", method, {"full", "plain"},
                 "full: each wall once, with arcs; plain: the recursion of pears section 4 alone, "
                 "for comparison");
  extractor.visit(visitor);
}

void RoomsConfig::visit(config::FieldVisitor& visitor) {
  visitor.text("map", map, "path of the rooms file, relative to the file that names it");
  visitor.numbers("initial_pose", initial_pose,
                  {"m, m, rad",
                   {},
                   "x, y and yaw of the robot in the map at the first scan; a node that has none "
                   "waits for initialpose"});
  visitor.numbers("initial_sigma", initial_sigma,
                  {"m, rad", config::kNotNegative,
                   "standard deviations of position and heading of the start pose, also where "
                   "initialpose brings no covariance"});
  visitor.number("map_resolution", map_resolution,
                 {"m", {0.005, 1.0}, "cell of the occupancy grid on the topic map"});
  visitor.group("tracker", tracker);
}

void RoomsConfig::check(const std::string& source) const {
  if (map.empty()) throw config::Error(source, 0, "map", "has to name a rooms file");
  if (!initial_pose.empty() && initial_pose.size() != 3) {
    throw config::Error(source, 0, "initial_pose", "expected x, y and yaw");
  }
  if (initial_sigma.size() != 2) {
    throw config::Error(source, 0, "initial_sigma", "expected position and heading");
  }
}

std::vector<std::string> InputConfig::laserTopics() const {
  return scans.empty() && range_scans.empty() ? std::vector<std::string>{"scan"} : scans;
}

std::vector<std::string> InputConfig::topics() const {
  std::vector<std::string> all = laserTopics();
  all.insert(all.end(), range_scans.begin(), range_scans.end());
  return all;
}

void InputConfig::visit(config::FieldVisitor& visitor) {
  visitor.text("odometry_topic", odometry_topic, "topic of the wheels' odometry");
  visitor.text("imu_topic", imu_topic, "topic of an inertial sensor");
  feed.visit(visitor);
  visitor.flag("leans", leans,
               "the scanner does not keep level, as on a person: beams that end on floor or "
               "ceiling are found and left out");
  visitor.group("floor", floor);
}

EstimatorsConfig EstimatorsConfig::readFile(const std::string& path) {
  const Node document = Node::readFile(path);
  document.allowOnly({"scans", "range_scans", "odometry_topic", "imu_topic", "frames", "mountings",
                      "noise", "odometry_source", "use_imu", "sweep_noise", "head_sigma",
                      "patience", "start_patience", "leans", "floor", "lines", "rooms", "carrier",
                      "odometry"});
  EstimatorsConfig config;
  readScans(document, config.input);
  readGroup(document, "frames", config.frames);
  if (document.has("mountings")) config.mountings = readMountings(document.at("mountings"));
  readCarrier(document, config);
  readShared(document, config.input);
  readGroup(document, "lines", config.lines);
  if (document.has("rooms")) config.rooms = readRooms(document.at("rooms"));
  return config;
}

}  // namespace sightline::pipeline
