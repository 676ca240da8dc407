#include "sightline/pipeline/estimators_config.h"

namespace sightline::pipeline {

void LinesConfig::visit(config::FieldVisitor& visitor) {
  visitor.choice("method", method, {"full", "plain"},
                 "full: each wall once, with arcs; plain: the recursion of pears section 4 alone, "
                 "for comparison");
  extractor.visit(visitor);
}

void RoomsConfig::visit(config::FieldVisitor& visitor) {
  visitor.path("map", map, "path of the rooms file; must be set");
  visitor.pose("initial_pose", initial_pose,
               "pose of the robot in the map at the first scan; without it the map is searched");
  visitor.numbers("initial_sigma", initial_sigma,
                  {"m, rad",
                   {0.0, 100.0},
                   "standard deviations of position and heading of the start pose, also where "
                   "initialpose brings no covariance"});
  visitor.number("map_resolution", map_resolution,
                 {"m", {0.005, 1.0}, "cell of the occupancy grid on the topic map"});
  visitor.group("tracker", tracker);
}

geometry::UncertainPose2 RoomsConfig::start() const {
  const double position = initial_sigma[0] * initial_sigma[0];
  const double heading = initial_sigma[1] * initial_sigma[1];
  return {*initial_pose, Eigen::Vector3d(position, position, heading).asDiagonal()};
}

std::vector<std::string> InputConfig::laserTopics() const {
  const bool none = scans.empty() && range_scans.empty() && echo_scans.empty();
  return none ? std::vector<std::string>{"scan"} : scans;
}

std::vector<std::string> InputConfig::topics() const {
  std::vector<std::string> all = laserTopics();
  all.insert(all.end(), range_scans.begin(), range_scans.end());
  all.insert(all.end(), echo_scans.begin(), echo_scans.end());
  return all;
}

void InputConfig::visit(config::FieldVisitor& visitor) {
  visitor.texts("scans", scans, "topics of the scanners; by default scan");
  visitor.texts("range_scans", range_scans,
                "topics of sensors that tell their variances and how their head turned");
  visitor.texts("echo_scans", echo_scans,
                "topics of scanners that report several echoes a beam, of which the first is used");
  visitor.text("odometry_topic", odometry_topic, "topic of the wheels' odometry");
  visitor.text("imu_topic", imu_topic, "topic of an inertial sensor");
  feed.visit(visitor);
  visitor.flag("leans", leans,
               "the scanner does not keep level, as on a person: beams that end on floor or "
               "ceiling are found and left out");
  visitor.group("floor", floor);
}

void EstimatorsConfig::visit(config::FieldVisitor& visitor) {
  input.visit(visitor);
  visitor.group("frames", frames);
  visitor.entries("mountings", mountings,
                  "pose of a scanner's frame on the base, where no transform tells");
  visitor.group("lines", lines);
  visitor.group("features", features);
  visitor.group("rooms", rooms);
  visitor.path("carrier", carrier,
               "path of a file with settings that depend on who carries the scanner, of which "
               "config/carriers has some; what stands beside it goes before what it says. Odometry "
               "from scans is then wanted");
  visitor.group("odometry", odometry);
  visitor.group("targets", targets);
}

EstimatorsConfig EstimatorsConfig::readFile(const std::string& path) {
  const config::Node document = config::Node::readFile(path);
  EstimatorsConfig config;
  config::read(document, config);
  if (!config.carrier.empty()) {
    const config::Node carrier = config::Node::readFile(config.carrier);
    carrier.allowOnly({"leans", "floor", "odometry"});
    EstimatorsConfig carried;
    carried.odometry.emplace();
    config::read(carrier, carried);
    config::read(document, carried);
    config = carried;
  }
  config.frames = config.frames.withoutSlashes();
  if (config.rooms && config.rooms->map.empty()) document.at("rooms").at("map");
  return config;
}

}  // namespace sightline::pipeline
