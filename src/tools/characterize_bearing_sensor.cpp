// Finds the models of bearing-only sensors by looks at targets whose places are known.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "program/program.h"
#include "sightline/bridge/bright_scan_picture.h"
#include "sightline/bridge/known_looks.h"
#include "sightline/config/error.h"
#include "sightline/config/yaml_writer.h"
#include "sightline/mapping/grid_map.h"
#include "sightline/pipeline/estimators_config.h"
#include "sightline/targets/target_log.h"

namespace {

using namespace sightline;

struct SensorJob {
  std::vector<std::string> in;
  std::string config;
  std::string truth;
  std::string out;
  std::optional<std::string> grid;  // path of a map_server's map
  std::optional<std::string> scan;  // topic of scans with intensities
  double beam_spacing = 1.0;        // [deg]
  double sigma = 2.25;              // [deg]
  double threshold = targets::BearingDetectorConfig{}.threshold;
};

void showProgress(double ratio) {
  static const bool on_terminal = isatty(STDERR_FILENO) == 1;
  static int shown = -1;
  const int percent = static_cast<int>(100.0 * ratio);
  if (!on_terminal || percent == shown) return;
  shown = percent;
  std::fprintf(stderr, "\rreading %3d %%%s", percent, percent == 100 ? "\n" : "");
}

void writeModels(const targets::Characterization& found, const std::string& path) {
  std::ofstream file(path);
  file << "# Made by characterize_bearing_sensor: models of the sensors of a team "
          "(SensorModelsConfig).\n"
       << config::toYaml(found.models());
  if (!file) throw config::Error(path, 0, "", "cannot be written");
}

void drawScan(const SensorJob& job) {
  targets::BearingDetectorConfig detector;
  detector.threshold = job.threshold;
  const auto scan = bridge::brightestScan(job.in, *job.scan, targets::BearingDetector(detector));
  if (!scan) throw config::Error(job.in.front(), 0, *job.scan, "no scan with intensities");
  bridge::drawBrightScan(*scan, detector, (std::filesystem::path(job.out) / "scan.png").string());
}

// What hides targets: the grid, or the world of the settings, or nothing.
std::shared_ptr<const targets::LineOfSight> sightOf(const SensorJob& job,
                                                    const targets::TargetTrackerConfig& settings) {
  if (!job.grid) return targets::worldSight(settings.world, settings.sensor_height);
  const mapping::GridMap map = mapping::readGridMap(*job.grid);
  return std::make_shared<targets::GridSight>(map.cells, map.T_map_grid);
}

int characterizeSensors(const SensorJob& job) {
  const auto settings = pipeline::EstimatorsConfig::readFile(job.config);
  if (!settings.targets) throw config::Error(job.config, 0, "targets", "missing");
  const auto targets_map = targets::readTargetTruth(job.truth);
  const auto recorded = bridge::readKnownLooks(job.in, *settings.targets, showProgress);
  if (recorded.looks.empty()) {
    throw config::Error(job.in.front(), 0, "", "no look has a pose");
  }
  targets::CharacterizationConfig config;
  config.field_of_view = recorded.field_of_view;
  config.range_max = recorded.range_max;
  config.beam_spacing = geometry::radians(job.beam_spacing);
  config.sigma = geometry::radians(job.sigma);
  config.spacing = settings.targets->tracker.spacing;
  const auto found = targets::characterize(recorded.looks, settings.targets->robots, targets_map,
                                           config, sightOf(job, settings.targets->tracker));
  std::filesystem::create_directories(job.out);
  writeModels(found, (std::filesystem::path(job.out) / "sensor_models.yaml").string());
  bridge::drawCharacterization(found, config, job.out);
  if (job.scan) drawScan(job);
  if (recorded.without_pose > 0) {
    std::printf("%zu looks left out: no pose\n", recorded.without_pose);
  }
  for (const std::string& line : found.report()) std::printf("%s\n", line.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  SensorJob job;
  tools::Program program("characterize_bearing_sensor",
                         "Finds the models of bearing-only sensors by looks at known targets.");
  program.positionals("IN.bag", job.in, "recordings of bearings and poses");
  program.requiredOption("--config", job.config, "FILE.yaml",
                         "settings as offline takes them: targets, with the robots");
  program.requiredOption("--targets", job.truth, "TRUTH.csv",
                         "`kind,id,x,y`, where kind is target");
  program.requiredOption("--out", job.out, "DIR", "folder for sensor_models.yaml and the pictures");
  program.option("--beam-spacing", job.beam_spacing, "DEGREES", "theta_sep of eq. 1, by default 1");
  program.option("--sigma", job.sigma, "DEGREES", "for the first labels, by default 2.25");
  program.option("--grid", job.grid, "MAP.yaml",
                 "of a map_server, whose occupied cells hide targets; without: the world of the "
                 "settings does");
  program.option("--scan", job.scan, "TOPIC",
                 "of scans with intensities, for a picture after figure 4 of one of them");
  program.option("--threshold", job.threshold, "INTENSITY",
                 "of bearing_detector, for that picture; by default 11000");
  return program.run(argc, argv, [&] { return characterizeSensors(job); });
}
