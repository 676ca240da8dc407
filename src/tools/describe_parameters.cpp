// Prints docs/Parameters.md from the field lists of the configuration structs.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nodes/laser_odometry_config.h"
#include "nodes/line_extractor_config.h"
#include "nodes/room_tracker_config.h"
#include "nodes/sim_sensor_config.h"
#include "nodes/sync_scan_driver_config.h"
#include "nodes/target_tracker_config.h"
#include "sightline/pipeline/estimators_config.h"
#include "sightline/simulation/active_sensor_profile.h"
#include "sightline/simulation/path.h"
#include "sightline/simulation/scanner_profile.h"

namespace {

using sightline::config::FieldDescription;

const char* const kHead = R"(# Parameters

Made by `rosrun sightline describe_parameters`; a test holds this page against the program.

A dot in a name is a level of the parameter tree: `tracker.gate.sigmas` is `~tracker/gate/sigmas` of the node, and
`tracker: {gate: {sigmas: 3.0}}` in YAML. What is outside its range stops the node at its start with the name, the value and
the range.
)";

void printTable(const std::string& title, const std::string& text,
                const std::vector<FieldDescription>& rows) {
  fmt::print("\n## {}\n\n{}\n\n", title, text);
  fmt::print("| name | type | default | unit | range | meaning |\n|---|---|---|---|---|---|\n");
  for (const FieldDescription& row : rows) {
    fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", row.key, row.type, row.default_value,
               row.unit, row.range, row.meaning);
  }
}

// A section for any struct with a field list, with the values that it holds as defaults.
template <class Config>
void print(const std::string& title, const std::string& text) {
  const Config defaults;
  printTable(title, text, sightline::config::describe(defaults));
}

void printNodes() {
  namespace nodes = sightline::nodes;
  print<nodes::LineExtractorNodeConfig>(
      "line_extractor",
      "Parameters of the node. `config/line_extractor.yaml` holds them with their defaults.");
  print<nodes::RoomTrackerNodeConfig>("room_tracker", "Parameters of the node.");
  print<nodes::LaserOdometryNodeConfig>(
      "laser_odometry",
      "Parameters of the node. `config/carriers` holds those that depend on who carries the "
      "scanner.");
  printTable("estimators", "Parameters of the node.",
             {{"config", "path", "(empty)", "-", "any",
               "the file of estimators that `offline` takes, too; must be set"}});
  print<nodes::TargetTrackerNodeConfig>("target_tracker", "Parameters of the node.");
  print<nodes::SyncScanDriverConfig>("sync_scan_driver", "Parameters of the node.");
  print<nodes::SimSensorConfig>("sim_sensor", "Parameters of the node.");
  print<nodes::SimRobotConfig>(
      "sim_sensor: robots",
      "Parameters of one robot, below `~robots/NAME` of sim_sensor: NAME is the namespace of its "
      "topics and the prefix of its frames. Without `~robots` there is one robot, and these are "
      "the node's own.");
  print<nodes::SimScannerConfig>("sim_sensor: scanners",
                                 "Parameters of one scanner, below `scanners/NAME` of its robot.");
  print<nodes::SimActiveSensorConfig>(
      "sim_sensor: active sensors",
      "Parameters of one sensor on a head, below `active_sensors/NAME` of its robot.");
  print<nodes::SimMoverConfig>(
      "sim_sensor: movers",
      "Parameters of one thing that moves through the world, below `~movers/NAME` of sim_sensor.");
}

void printFiles() {
  namespace simulation = sightline::simulation;
  print<sightline::targets::SensorModelsConfig>(
      "Files of sensor models",
      "What `characterize_bearing_sensor` writes and `models` of target_tracker names.");
  print<sightline::pipeline::EstimatorsConfig>("Files of estimators",
                                               "What `offline`, `replay.launch` and the node "
                                               "estimators are given. `rooms` and `odometry` are "
                                               "there where these estimators are wanted.");
  print<simulation::ActiveSensorProfile>(
      "Active sensor profiles",
      "The files of `config/sensors` for synchronised-scan sensors, real or simulated.");
  print<simulation::ScannerProfile>("Scanner profiles",
                                    "The files of `config/sensors` for time-of-flight scanners.");
  auto path = sightline::config::describe<simulation::Path>();
  path.push_back({"waypoints", "list of [x, y]", "-", "m", "[-1e6, 1e6]",
                  "points of the path, in the map; must be set"});
  printTable("Paths", "The files of `config/paths`, which say where a simulated robot drives.",
             path);
}

}  // namespace

int main() {
  fmt::print("{}", kHead);
  printNodes();
  printFiles();
  return 0;
}
