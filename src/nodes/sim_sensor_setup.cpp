#include "nodes/sim_sensor_setup.h"

#include <set>

namespace sightline::nodes {

namespace {

// Names that only one may have.
class Claims {
 public:
  void claim(const char* what, const std::string& name, const config::Node& parameter) {
    if (!claimed_.insert(std::string(what) + " " + name).second) {
      parameter.fail(std::string("another has the ") + what + " '" + name + "' already");
    }
  }

 private:
  std::set<std::string> claimed_;
};

// Nodes below a key, by name; nothing where there is no such key.
std::vector<std::pair<std::string, config::Node>> namedBelow(const config::Node& parameters,
                                                             const char* key) {
  if (!parameters.has(key)) return {};
  return parameters.at(key).entries();
}

std::string prefixed(const std::string& robot, const std::string& name) {
  return robot.empty() || (!name.empty() && name[0] == '/') ? name : robot + "/" + name;
}

// Reads one robot after the other; keeps what their names are.
class RobotReader {
 public:
  SimRobotSetup read(const std::string& name, const config::Node& parameters) {
    SimRobotSetup robot;
    robot.name = name;
    config::read(parameters, robot.config, config::UnknownKeys::kIgnore);
    for (std::string* frame : {&robot.config.odom_frame, &robot.config.base_frame}) {
      claimFrame(name, *frame, parameters);
    }
    readScanners(parameters, robot);
    readActiveSensors(parameters, robot);
    return robot;
  }

 private:
  // Prefixes the frame's name, too.
  void claimFrame(const std::string& robot, std::string& frame, const config::Node& parameter) {
    frame = prefixed(robot, frame);
    claims_.claim("frame", frame, parameter);
  }

  void readScanners(const config::Node& parameters, SimRobotSetup& robot) {
    const bool is_default = !parameters.has("scanners") && !parameters.has("active_sensors");
    if (is_default) addScanner({}, parameters, robot);
    for (const auto& [name, parameter] : namedBelow(parameters, "scanners")) {
      SimScannerConfig scanner;
      config::read(parameter, scanner);
      addScanner(scanner, parameter, robot);
    }
  }

  void addScanner(SimScannerConfig scanner, const config::Node& parameter, SimRobotSetup& robot) {
    claims_.claim("topic", prefixed(robot.name, scanner.topic), parameter);
    claimFrame(robot.name, scanner.frame, parameter);
    robot.scanners.push_back(scanner);
  }

  void readActiveSensors(const config::Node& parameters, SimRobotSetup& robot) {
    for (const auto& [name, parameter] : namedBelow(parameters, "active_sensors")) {
      SimActiveSensorConfig sensor;
      config::read(parameter, sensor);
      bridge::ActiveSensorNames& names = sensor.names;
      for (const std::string& topic : {names.scan, names.range_scan, names.head_command}) {
        claims_.claim("topic", prefixed(robot.name, topic), parameter);
      }
      driver::HeadFrames& frames = names.frames;
      for (std::string* frame : {&frames.mount, &frames.head, &frames.projection}) {
        claimFrame(robot.name, *frame, parameter);
      }
      claims_.claim("joint", prefixed(robot.name, frames.joint), parameter);
      robot.active_sensors.push_back(sensor);
    }
  }

  Claims claims_;
};

SimMoverConfig readMover(const config::Node& parameters) {
  SimMoverConfig mover;
  config::read(parameters, mover);
  if (mover.path.empty()) parameters.fail("path has to name a path file");
  return mover;
}

}  // namespace

SimSetup SimSetup::read(const config::Node& parameters) {
  SimSetup setup;
  config::read(parameters, setup.node, config::UnknownKeys::kIgnore);
  if (setup.node.world.empty()) {
    throw config::Error(parameters.source(), 0, "world", "has to name a world file");
  }
  RobotReader reader;
  for (const auto& [name, parameter] : namedBelow(parameters, "robots")) {
    setup.robots.push_back(reader.read(name, parameter));
  }
  if (setup.robots.empty()) setup.robots.push_back(reader.read("", parameters));
  for (const auto& [name, parameter] : namedBelow(parameters, "movers")) {
    setup.movers.push_back(readMover(parameter));
  }
  return setup;
}

}  // namespace sightline::nodes
