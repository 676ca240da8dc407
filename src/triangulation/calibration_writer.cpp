#include "sightline/triangulation/calibration_writer.h"

#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "sightline/config/yaml_writer.h"

namespace sightline::triangulation {

namespace {

std::string cell(double value) {
  return std::isnan(value) ? ".nan" : fmt::format("{}", value);
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + cell(value);
  return "[" + text + "]";
}

}  // namespace

CalibrationTable tableOf(const CalibrationRecording& recording, const ScanPattern& scan,
                         const std::string& source) {
  std::map<double, const TargetPlacement*> targets;
  for (const TargetPlacement& target : recording.placements) {
    if (!target.stripes) targets.emplace(target.depth, &target);
  }
  const auto beams = static_cast<std::size_t>(scan.beams);
  const double unseen = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> depths;
  std::vector<std::vector<double>> rows(beams, std::vector<double>(targets.size(), unseen));
  for (const auto& [depth, target] : targets) {
    for (const BeamAverage& seen : target->beams) {
      rows.at(seen.beam)[depths.size()] = seen.image_position;
    }
    depths.push_back(depth);
  }
  return {std::move(depths), std::move(rows), source};
}

std::string toYaml(const Calibration& calibration, const ParameterVector& sigmas) {
  std::string text = config::toYaml(calibration.parameters);
  text += "standard_deviations:\n";
  for (int i = 0; i < kParameterCount; ++i) {
    const ParameterName& name = kParameterNames[static_cast<std::size_t>(i)];
    text += fmt::format("  {}: {:.4g} # {}\n", name.key, sigmas[i], name.unit);
  }
  text += "table:\n  depths: " + list(calibration.table.depths()) + " # m, of the targets\n";
  text += "  image_positions: # m, one row a beam\n";
  for (std::size_t beam = 0; beam < calibration.table.beams(); ++beam) {
    text += "    - " + list(calibration.table.imagePositions(beam)) + "\n";
  }
  return text;
}

}  // namespace sightline::triangulation
