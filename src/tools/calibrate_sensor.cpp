// Calibrates a triangulation sensor from a recording, or from one that a simulated rig makes.
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
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
  std::optional<std::string> seed;       // or this
  std::string out;
};

std::uint64_t seedOf(const std::string& text) {
  std::uint64_t seed = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
    throw tools::UsageError("--simulate needs a whole number, not '" + text + "'");
  }
  return seed;
}

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
  fmt::print("stripe edges: {} used, residual {:.3f} mm rms, {:.3f} mm of it not of the currents\n",
             estimate.edges.size(), 1e3 * estimate.edgeRms(), 1e3 * estimate.edge_scatter);
  const double chi_square = estimate.reducedChiSquare();
  fmt::print("chi-square: {:.3f} per degree of freedom\n", chi_square);
  if (std::abs(chi_square - 1.0) > 5.0 * std::sqrt(2.0 / freedom)) {
    fmt::print(
        "  which noise does not explain: see to the noise current, the beam width and the "
        "places of the targets\n");
  }
}

double degrees(double angle) {
  return angle * 180.0 / geometry::kPi;
}

// Image positions against angle and depth.
std::vector<plot::Panel> imagePanels(const ParameterEstimate& estimate) {
  plot::Panel map{"Residuals of image position",
                  "scan angle [°]",
                  "1 / depth [1/m]",
                  "[standard deviations]",
                  3.0,
                  {{"", plot::Style::kColouredPoints, {}}}};
  plot::Panel by_angle{"Image position, by angle",
                       "scan angle [°]",
                       "residual [µm]",
                       "depth [m]",
                       0.0,
                       {{"", plot::Style::kColouredPoints, {}}}};
  plot::Panel by_depth{
      "Image position, by depth", "depth [m]", "residual [µm]",
      "scan angle [°]",           0.0,         {{"", plot::Style::kColouredPoints, {}}}};
  for (std::size_t i = 0; i < estimate.images.size(); ++i) {
    const auto& image = estimate.images[i];
    const double residual = estimate.residuals[static_cast<Eigen::Index>(i)];
    const double angle = degrees(image.scan_angle);
    const double error = 1e6 * residual * image.sigma;
    map.series[0].points.push_back({angle, 1.0 / image.depth, residual});
    by_angle.series[0].points.push_back({angle, error, image.depth});
    by_depth.series[0].points.push_back({image.depth, error, angle});
  }
  return {map, by_angle, by_depth};
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
  figure.panels = imagePanels(estimate);
  figure.panels.push_back(edgePanel(estimate));
  plot::writePng(figure, path.string());
}

triangulation::CalibrationRecording recordingOf(const Job& job,
                                                const simulation::ActiveSensorProfile& profile) {
  if (job.recording) {
    return triangulation::readRecording(config::CsvTable::readFile(*job.recording), profile.sensor);
  }
  return recordCalibration(profile.sensor, profile.optics, profile.rig, seedOf(*job.seed));
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
