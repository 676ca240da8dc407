#include "sightline/triangulation/calibration_recording.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace sightline::triangulation {

namespace {

using CsvRow = config::CsvTable::Row;

// Rows of one placement agree in these; those of plain targets in a width of 0.
using PlacementKey = std::tuple<double, double, double>;  // stripe width, stripe edge, depth

PlacementKey placementOf(const CsvRow& row, const SensorParameters& sensor) {
  const double depth = row.number("depth_m", {1e-3, 100.0});
  if (depth <= sensor.origin.x) {
    row.fail("depth_m", fmt::format("{} is not ahead of the scan's origin", depth));
  }
  const std::string& kind = row.text("target");
  if (kind == "plain") return {0.0, 0.0, depth};
  if (kind != "striped") row.fail("target", fmt::format("'{}' is neither plain nor striped", kind));
  return {row.number("stripe_width_m", {1e-3, 10.0}), row.number("stripe_edge_m", {-10.0, 10.0}),
          depth};
}

BeamAverage readBeam(const CsvRow& row, const SensorParameters& sensor) {
  const double half_detector = 0.5 * sensor.intrinsics.detector_length;
  BeamAverage average;
  average.beam = static_cast<std::size_t>(row.integer("beam", {0.0, sensor.scan.beams - 1.0}));
  average.readings = row.integer("readings", {1.0, 1e9});
  average.image_position = row.number("image_position_m", {-half_detector, half_detector});
  average.current = row.number("current_A", {1e-15, 1e-3});
  return average;
}

using BeamsOfPlacement = std::map<std::size_t, BeamAverage>;

TargetPlacement toPlacement(const PlacementKey& key, const BeamsOfPlacement& beams) {
  const auto [width, edge, depth] = key;
  TargetPlacement placement;
  placement.depth = depth;
  if (width > 0.0) placement.stripes = Stripes{edge, width};
  std::transform(beams.begin(), beams.end(), std::back_inserter(placement.beams),
                 [](const auto& entry) { return entry.second; });
  return placement;
}

}  // namespace

CalibrationRecording readRecording(const config::CsvTable& table, const SensorParameters& sensor) {
  if (table.rows() == 0) throw config::Error(table.source(), 0, "", "holds no reading");
  std::map<PlacementKey, BeamsOfPlacement> placements;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const CsvRow row = table.row(i);
    const BeamAverage average = readBeam(row, sensor);
    if (!placements[placementOf(row, sensor)].emplace(average.beam, average).second) {
      row.fail("beam", fmt::format("{} saw this target before", average.beam));
    }
  }
  CalibrationRecording recording;
  for (const auto& [key, beams] : placements) {
    recording.placements.push_back(toPlacement(key, beams));
  }
  return recording;
}

std::string toCsv(const CalibrationRecording& recording) {
  std::string text =
      "target,depth_m,beam,readings,image_position_m,current_A,stripe_edge_m,stripe_width_m\n";
  for (const TargetPlacement& placement : recording.placements) {
    const auto& stripes = placement.stripes;
    const std::string target = fmt::format("{},{}", stripes ? "striped" : "plain", placement.depth);
    const std::string ending =
        stripes ? fmt::format("{},{}", stripes->edge, stripes->width) : std::string(",");
    for (const BeamAverage& seen : placement.beams) {
      text += fmt::format("{},{},{},{},{},{}\n", target, seen.beam, seen.readings,
                          seen.image_position, seen.current, ending);
    }
  }
  return text;
}

}  // namespace sightline::triangulation
