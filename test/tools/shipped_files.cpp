// Every file that is shipped loads.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "nodes/bearing_detector_config.h"
#include "nodes/gaze_config.h"
#include "nodes/line_extractor_config.h"
#include "nodes/room_tracker_config.h"
#include "nodes/search_config.h"
#include "nodes/target_tracker_config.h"
#include "sightline/pipeline/estimators_config.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/simulation/active_sensor_profile.h"
#include "sightline/simulation/path.h"
#include "sightline/simulation/scanner_profile.h"
#include "sightline/world/room_map.h"
#include "sightline/world/world.h"
#include "tools/program.h"

namespace sightline {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SIGHTLINE_SOURCE_DIR;

std::vector<std::string> filesBelow(const std::string& folder, const std::string& extension) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void expectToLoad(const std::string& folder, const std::function<void(const std::string&)>& load) {
  const auto files = filesBelow(folder, ".yaml");
  EXPECT_FALSE(files.empty()) << folder;
  for (const std::string& file : files) EXPECT_NO_THROW(load(file)) << file;
}

template <class Config>
void expectParameters(const std::string& file) {
  Config config;
  EXPECT_NO_THROW(
      config::read(config::Node::readFile((kSource / "config" / file).string()), config));
}

TEST(ShippedFiles, Rooms) {
  expectToLoad("config/rooms", world::RoomMap::readFile);
}
TEST(ShippedFiles, Worlds) {
  expectToLoad("config/worlds", [](const std::string& file) {
    // Furniture is of the materials that the world which includes it names.
    if (file.find("/furniture/") == std::string::npos) world::World::readFile(file);
  });
}
TEST(ShippedFiles, Sensors) {
  expectToLoad("config/sensors", [](const std::string& path) {
    if (config::Node::readFile(path).has("sensor")) {
      simulation::ActiveSensorProfile::readFile(path).calibrated();
    } else {
      simulation::ScannerProfile::readFile(path);
    }
  });
}
TEST(ShippedFiles, Paths) {
  expectToLoad("config/paths", simulation::Path::readFile);
}
TEST(ShippedFiles, Offline) {
  expectToLoad("config/offline", pipeline::EstimatorsConfig::readFile);
}
TEST(ShippedFiles, Carriers) {
  expectToLoad("config/carriers", [](const std::string& file) {
    const auto document = config::Node::readFile(file);
    document.allowOnly({"leans", "floor", "odometry"});
    pipeline::InputConfig input;
    EXPECT_NO_THROW(config::read(document, input, config::UnknownKeys::kIgnore));
    pipeline::ScanOdometryConfig config;
    config::read(document.at("odometry"), config);
    EXPECT_NO_THROW(pipeline::ScanOdometry{config});
  });
}
TEST(ShippedFiles, Replay) {
  expectToLoad("config/replay", pipeline::EstimatorsConfig::readFile);
}

TEST(ShippedFiles, BearingSensors) {
  expectToLoad("config/bearing_sensors", targets::SensorModelsConfig::readFile);
}

TEST(ShippedFiles, Parameters) {
  expectParameters<nodes::LineExtractorNodeConfig>("line_extractor.yaml");
  expectParameters<nodes::GazeNodeConfig>("gaze.yaml");
  expectParameters<nodes::GazeNodeConfig>("gaze_turret.yaml");
  expectParameters<nodes::RoomTrackerNodeConfig>("room_tracker.yaml");
  expectParameters<nodes::TargetTrackerNodeConfig>("target_tracker.yaml");
  expectParameters<nodes::BearingDetectorNodeConfig>("bearing_detector.yaml");
  expectParameters<nodes::SearchNodeConfig>("search.yaml");
}

TEST(ShippedFiles, EveryConfigurationHasARoomAbove) {
  for (const std::string& file : filesBelow("config", ".yaml")) {
    const std::string folder = fs::relative(file, kSource / "config").begin()->string();
    const std::vector<std::string> known{"rooms",
                                         "worlds",
                                         "sensors",
                                         "paths",
                                         "offline",
                                         "replay",
                                         "carriers",
                                         "gaze.yaml",
                                         "gaze_turret.yaml",
                                         "line_extractor.yaml",
                                         "room_tracker.yaml",
                                         "bearing_sensors",
                                         "bearing_detector.yaml",
                                         "search.yaml",
                                         "target_tracker.yaml"};
    EXPECT_NE(std::find(known.begin(), known.end(), folder), known.end())
        << file << " is loaded by no test";
  }
}

TEST(ShippedFiles, Launch) {
  const auto files = filesBelow("launch", ".launch");
  EXPECT_GE(files.size(), 4U);
  for (const std::string& file : files) {
    // Arguments without a default; those that a file does not have are refused only by the
    // including one.
    std::string arguments;
    if (file.find("replay") != std::string::npos) arguments = " bag:=a.bag config:=a.yaml";
    if (file.find("room_tracker") != std::string::npos) arguments = " rooms:=rooms.yaml";
    if (file.find("team_robot") != std::string::npos) {
      arguments = " robot:=r rooms:=rooms.yaml start:=[0,0,0]";
    }
    const auto result = test::runCommand("roslaunch --nodes " + file + arguments);
    EXPECT_EQ(result.status, 0) << file << ": " << result.output;
    EXPECT_NE(result.output.find('/'), std::string::npos) << file << " starts nothing";
  }
}

TEST(ShippedFiles, Rviz) {
  const auto files = filesBelow("rviz", ".rviz");
  EXPECT_FALSE(files.empty());
  for (const std::string& file : files) {
    const auto rviz = config::Node::readFile(file);
    EXPECT_FALSE(rviz.at("Visualization Manager").at("Displays").items().empty()) << file;
  }
}

TEST(DescribeParameters, ThePageIsUpToDate) {
  const auto printed = test::runProgram("describe_parameters", "");
  const auto page = test::runCommand("cat " + (kSource / "docs/Parameters.md").string());
  EXPECT_EQ(printed.output, page.output)
      << "run: scripts/env rosrun sightline describe_parameters > docs/Parameters.md";
}

}  // namespace
}  // namespace sightline
