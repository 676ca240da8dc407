// Prints docs/Parameters.md from the field lists of the configuration structs.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nodes/laser_odometry_config.h"
#include "nodes/line_extractor_config.h"
#include "nodes/room_tracker_config.h"
#include "nodes/sim_sensor_config.h"
#include "nodes/sync_scan_driver_config.h"
#include "sightline/simulation/active_sensor_profile.h"
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

}  // namespace

int main() {
  using sightline::config::describe;
  namespace nodes = sightline::nodes;
  fmt::print("{}", kHead);
  printTable("line_extractor",
             "Parameters of the node. `config/line_extractor.yaml` holds them with their defaults.",
             describe<nodes::LineExtractorNodeConfig>());
  printTable("room_tracker", "Parameters of the node.", describe<nodes::RoomTrackerNodeConfig>());
  printTable("laser_odometry",
             "Parameters of the node. `config/carriers` holds those that depend on who carries the "
             "scanner.",
             describe<nodes::LaserOdometryNodeConfig>());
  const nodes::SyncScanDriverConfig driver;
  printTable("sync_scan_driver", "Parameters of the node.", describe(driver));
  printTable("sim_sensor", "Parameters of the node.", describe<nodes::SimSensorConfig>());
  printTable(
      "sim_sensor: robots",
      "Parameters of one robot, below `~robots/NAME` of sim_sensor: NAME is the namespace of "
      "its topics and the prefix of its frames. Without `~robots` there is one robot, and "
      "these are the node's own.",
      describe<nodes::SimRobotConfig>());
  printTable("sim_sensor: scanners",
             "Parameters of one scanner, below `scanners/NAME` of its robot.",
             describe<nodes::SimScannerConfig>());
  printTable("sim_sensor: active sensors",
             "Parameters of one sensor on a head, below `active_sensors/NAME` of its robot.",
             describe<nodes::SimActiveSensorConfig>());
  printTable("sim_sensor: movers",
             "Parameters of one thing that moves through the world, below `~movers/NAME` of "
             "sim_sensor.",
             describe<nodes::SimMoverConfig>());
  printTable("Active sensor profiles",
             "The files of `config/sensors` for synchronised-scan sensors, real or simulated.",
             describe<sightline::simulation::ActiveSensorProfile>());
  printTable("Scanner profiles", "The files of `config/sensors` for time-of-flight scanners.",
             describe<sightline::simulation::ScannerProfile>());
  return 0;
}
