// Prints docs/Parameters.md from the field lists of the configuration structs.
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nodes/bearing_detector_config.h"
#include "nodes/gaze_config.h"
#include "nodes/laser_odometry_config.h"
#include "nodes/line_extractor_config.h"
#include "nodes/room_tracker_config.h"
#include "nodes/search_config.h"
#include "nodes/sim_sensor_config.h"
#include "nodes/sync_scan_driver_config.h"
#include "nodes/target_tracker_config.h"
#include "program/program.h"
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

struct Section {
  std::string title;
  std::string text;
  std::vector<FieldDescription> rows;
};

void print(const Section& section) {
  fmt::print("\n## {}\n\n{}\n\n", section.title, section.text);
  fmt::print("| name | type | default | unit | range | meaning |\n|---|---|---|---|---|---|\n");
  for (const FieldDescription& row : section.rows) {
    fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", row.key, row.type, row.default_value,
               row.unit, row.range, row.meaning);
  }
}

// Takes any struct with a field list, with the values that it holds as defaults.
template <class Config>
Section sectionOf(const std::string& title, const std::string& text) {
  const Config defaults;
  return {title, text, sightline::config::describe(defaults)};
}

std::vector<Section> estimatorSections() {
  namespace nodes = sightline::nodes;
  return {
      sectionOf<nodes::LineExtractorNodeConfig>(
          "line_extractor",
          "Parameters of the node. `config/line_extractor.yaml` holds them with their defaults."),
      sectionOf<nodes::RoomTrackerNodeConfig>("room_tracker", "Parameters of the node."),
      sectionOf<nodes::LaserOdometryNodeConfig>(
          "laser_odometry",
          "Parameters of the node. `config/carriers` holds those that depend on who carries the "
          "scanner."),
      Section{"estimators",
              "Parameters of the node.",
              {{"config", "path", "(empty)", "-", "any",
                "the file of estimators that `offline` takes, too; must be set"}}},
      sectionOf<nodes::BearingDetectorNodeConfig>(
          "bearing_detector",
          "Parameters of the node. `config/bearing_detector.yaml` holds them with their defaults."),
      sectionOf<nodes::TargetTrackerNodeConfig>("target_tracker", "Parameters of the node."),
      sectionOf<nodes::SearchNodeConfig>("search", "Parameters of the node."),
      sectionOf<nodes::GazeNodeConfig>("gaze", "Parameters of the node."),
  };
}

std::vector<Section> sensorSections() {
  namespace nodes = sightline::nodes;
  return {
      sectionOf<nodes::SyncScanDriverConfig>("sync_scan_driver", "Parameters of the node."),
      sectionOf<nodes::SimSensorConfig>("sim_sensor", "Parameters of the node."),
      sectionOf<nodes::SimRobotConfig>("sim_sensor: robots",
                                       "Parameters of one robot, below `~robots/NAME` of "
                                       "sim_sensor: NAME is the namespace of its "
                                       "topics and the prefix of its frames. Without `~robots` "
                                       "there is one robot, and these are "
                                       "the node's own."),
      sectionOf<nodes::SimScannerConfig>(
          "sim_sensor: scanners", "Parameters of one scanner, below `scanners/NAME` of its robot."),
      sectionOf<nodes::SimActiveSensorConfig>(
          "sim_sensor: active sensors",
          "Parameters of one sensor on a head, below `active_sensors/NAME` of its robot."),
      sectionOf<nodes::SimMoverConfig>("sim_sensor: movers",
                                       "Parameters of one thing that moves through the world, "
                                       "below `~movers/NAME` of sim_sensor."),
  };
}

std::vector<Section> fileSections() {
  namespace simulation = sightline::simulation;
  auto path = sightline::config::describe<simulation::Path>();
  path.push_back({"waypoints", "list of [x, y]", "-", "m", "[-1e6, 1e6]",
                  "points of the path, in the map; must be set"});
  return {
      sectionOf<sightline::targets::SensorModelsConfig>(
          "Files of sensor models",
          "What `characterize_bearing_sensor` writes and `models` of target_tracker names."),
      sectionOf<sightline::pipeline::EstimatorsConfig>(
          "Files of estimators",
          "What `offline`, `replay.launch` and the node "
          "estimators are given. `rooms` and `odometry` are "
          "there where these estimators are wanted."),
      sectionOf<simulation::ActiveSensorProfile>(
          "Active sensor profiles",
          "The files of `config/sensors` for synchronised-scan sensors, real or simulated."),
      sectionOf<simulation::ScannerProfile>(
          "Scanner profiles", "The files of `config/sensors` for time-of-flight scanners."),
      Section{"Paths", "The files of `config/paths`, which say where a simulated robot drives.",
              path},
  };
}

std::vector<Section> allSections() {
  std::vector<Section> sections;
  for (const auto& part : {estimatorSections(), sensorSections(), fileSections()}) {
    sections.insert(sections.end(), part.begin(), part.end());
  }
  return sections;
}

// Sections of a node: its own and those of the parts of its tree.
bool isOf(const Section& section, const std::string& node) {
  return section.title == node || section.title.rfind(node + ":", 0) == 0;
}

int describe(const std::optional<std::string>& node) {
  const std::vector<Section> sections = allSections();
  if (!node) fmt::print("{}", kHead);
  bool is_known = !node;
  for (const Section& section : sections) {
    if (node && !isOf(section, *node)) continue;
    is_known = true;
    print(section);
  }
  if (is_known) return 0;
  std::string names;
  for (const Section& section : sections) names += "\n  " + section.title;
  throw sightline::tools::UsageError("no section '" + *node + "'; there are:" + names);
}

}  // namespace

int main(int argc, char** argv) {
  std::optional<std::string> node;
  sightline::tools::Program program(
      "describe_parameters",
      "Prints every parameter of the nodes and every key of their files, with unit, range and "
      "default, as in docs/Parameters.md.");
  program.positional("NODE", node, "a node, or another section, alone");
  return program.run(argc, argv, [&] { return describe(node); });
}
