// Calibrates a triangulation sensor from a recording, or from one that a simulated rig makes.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "program/program.h"
#include "sightline/plot/figure.h"
#include "sightline/simulation/active_sensor_profile.h"
#include "sightline/triangulation/calibration_writer.h"

namespace {

using namespace sightline;
using triangulation::ParameterEstimate;

struct Job {
  std::string sensor;
  std::optional<std::string> recording;  // either this
  std::optional<std::uint64_t> seed;     // or this
  std::string out;
};

void writeFile(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw config::Error(path.string(), 0, "", "cannot be written");
}

// Degrees and millimetres, as people think of them.
void print(const ParameterEstimate& estimate) {
  const auto values = toVector(estimate.intrinsics, estimate.origin);
  for (int i = 0; i < triangulation::kParameterCount; ++i) {
    const auto& [key, unit] = triangulation::kParameterNames[static_cast<std::size_t>(i)];
    const bool is_angle = std::string(unit) == "rad";
    const double scale = is_angle ? 180.0 / geometry::kPi : 1e3;
    fmt::print("{:<26} {:9.4f} {:<3} +- {:.4f}\n", key, scale * values[i], is_angle ? "deg" : "mm",
               scale * estimate.sigma(i));
  }
}

void printResiduals(const ParameterEstimate& estimate) {
  const double freedom =
      static_cast<double>(estimate.residuals.size() - triangulation::kParameterCount);
  fmt::print("image positions: {} used, residual {:.2f} um rms\n", estimate.images.size(),
             1e6 * estimate.imageRms());
  fmt::print(
      "stripe edges: {} used, residual {:.3f} mm rms; {:.3f} mm beyond the noise of the "
      "currents\n",
      estimate.edges.size(), 1e3 * estimate.edgeRms(), 1e3 * estimate.edge_scatter);
  const double chi_square = estimate.reducedChiSquare();
  fmt::print("chi-square: {:.3f} per degree of freedom\n", chi_square);
  if (std::abs(chi_square - 1.0) > 5.0 * std::sqrt(2.0 / freedom)) {
    fmt::print(
        "  which noise does not explain: see to the noise current, the beam width and the "
        "places of the targets\n");
  }
}

// Whether anything is left in the table: it would be a pattern in colour.
plot::Panel tablePanel(const ParameterEstimate& estimate) {
  plot::Panel panel{"Image position",
                    "scan angle [°]",
                    "1 / depth [1/m]",
                    "residual [standard deviations]",
                    3.0,
                    {{"", plot::Style::kColouredPoints, {}}}};
  for (std::size_t i = 0; i < estimate.images.size(); ++i) {
    const auto& image = estimate.images[i];
    panel.series[0].points.push_back({geometry::degrees(image.scan_angle), 1.0 / image.depth,
                                      estimate.residuals[static_cast<Eigen::Index>(i)]});
  }
  return panel;
}

double imageError(const ParameterEstimate& estimate, std::size_t i) {  // µm
  return 1e6 * estimate.residuals[static_cast<Eigen::Index>(i)] * estimate.images[i].sigma;
}

plot::Panel anglePanel(const ParameterEstimate& estimate) {
  plot::Panel panel{"Image position, by angle",
                    "scan angle [°]",
                    "residual [µm]",
                    "depth [m]",
                    0.0,
                    {{"", plot::Style::kColouredPoints, {}}}};
  for (std::size_t i = 0; i < estimate.images.size(); ++i) {
    const auto& image = estimate.images[i];
    panel.series[0].points.push_back(
        {geometry::degrees(image.scan_angle), imageError(estimate, i), image.depth});
  }
  return panel;
}

// Between the lines, drawn for the middle beam, 95 % are expected.
plot::Panel depthPanel(const ParameterEstimate& estimate) {
  std::map<double, std::vector<double>> sigmas;
  plot::Panel panel{"Image position, by depth", "depth [m]", "residual [µm]", "", 0.0, {}};
  panel.series = {{"measured less predicted", plot::Style::kPoints, {}},
                  {"twice the predicted noise, either way", plot::Style::kLine, {}}};
  for (std::size_t i = 0; i < estimate.images.size(); ++i) {
    panel.series[0].points.push_back({estimate.images[i].depth, imageError(estimate, i)});
    sigmas[estimate.images[i].depth].push_back(1e6 * estimate.images[i].sigma);
  }
  for (const double side : {2.0, -2.0}) {
    for (const auto& [depth, values] : sigmas) {
      panel.series[1].points.push_back({depth, side * values[values.size() / 2]});
    }
    panel.series[1].points.push_back({std::nan(""), 0.0});
  }
  return panel;
}

plot::Panel edgePanel(const ParameterEstimate& estimate) {
  plot::Panel panel{"Stripe edges",
                    "y of the edge [m]",
                    "residual at the edge [mm]",
                    "depth [m]",
                    0.0,
                    {{"", plot::Style::kColouredPoints, {}}}};
  const auto first = static_cast<Eigen::Index>(estimate.images.size());
  for (std::size_t i = 0; i < estimate.edges.size(); ++i) {
    const auto& edge = estimate.edges[i];
    const double ahead = edge.depth - estimate.origin.x;
    const double aside = edge.y - estimate.origin.y;
    const double angle = estimate.residuals[first + static_cast<Eigen::Index>(i)] * edge.sigma;
    const double lateral = angle * (ahead * ahead + aside * aside) / ahead;
    panel.series[0].points.push_back({edge.y, 1e3 * lateral, edge.depth});
  }
  return panel;
}

void draw(const ParameterEstimate& estimate, const std::filesystem::path& path) {
  plot::Figure figure;
  figure.width = 1400;
  figure.height = 1000;
  figure.columns = 2;
  figure.panels = {tablePanel(estimate), anglePanel(estimate), depthPanel(estimate),
                   edgePanel(estimate)};
  plot::writePng(figure, path.string());
}

triangulation::CalibrationRecording recordingOf(const Job& job,
                                                const simulation::ActiveSensorProfile& profile) {
  if (job.recording) {
    return triangulation::readRecording(config::CsvTable::readFile(*job.recording), profile.sensor);
  }
  return recordCalibration(profile.sensor, profile.optics, profile.rig, *job.seed);
}

int calibrate(const Job& job) {
  if (job.recording.has_value() == job.seed.has_value()) {
    throw tools::UsageError("either RECORDING.csv or --simulate is needed");
  }
  const auto profile = simulation::ActiveSensorProfile::readFile(job.sensor);
  const auto recording = recordingOf(job, profile);
  const std::string source = job.recording.value_or("simulated recording");
  const ParameterEstimate estimate = triangulation::estimateParameters(
      recording, profile.sensor, profile.optics.beam_width, source);
  triangulation::Calibration calibration{
      profile.sensor, triangulation::tableOf(recording, profile.sensor.scan, source)};
  calibration.parameters.intrinsics = estimate.intrinsics;
  calibration.parameters.origin = estimate.origin;

  fmt::print("calibration of {}\n", profile.sensor.serial);
  print(estimate);
  printResiduals(estimate);
  const std::filesystem::path folder = job.out;
  std::filesystem::create_directories(folder);
  writeFile(folder / "calibration.yaml",
            toYaml(calibration, estimate.covariance.diagonal().cwiseSqrt()));
  if (job.seed) writeFile(folder / "recording.csv", toCsv(recording));
  draw(estimate, folder / "residuals.png");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Job job;
  tools::Program program("calibrate_sensor",
                         "Calibrates a triangulation sensor: writes calibration.yaml, and "
                         "residuals.png to judge it by.");
  program.positional("RECORDING.csv", job.recording,
                     "what a rig recorded: columns target (plain or striped), depth_m, beam, "
                     "readings, image_position_m, current_A, stripe_edge_m, stripe_width_m");
  program.requiredOption("--sensor", job.sensor, "SENSOR.yaml",
                         "what the sensor was built to be; as in config/sensors");
  program.option("--simulate", job.seed, "SEED",
                 "record with the rig that SENSOR.yaml describes; writes recording.csv, too");
  program.requiredOption("--out", job.out, "DIR", "where the files go");
  return program.run(argc, argv, [&] { return calibrate(job); });
}
