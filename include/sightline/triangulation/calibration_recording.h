#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sightline/config/csv_table.h"
#include "sightline/triangulation/calibration.h"

namespace sightline::triangulation {

/// Dark and bright stripes of one width, upright, side by side.
struct Stripes {
  double edge = 0.0;   ///< y [m] in the sensor frame of an edge with a bright stripe to its left
  double width = 0.0;  ///< [m], of every stripe

  /// y [m] of the edge `index` stripes to the left; those of even index have bright to their left.
  double edgeAt(int index) const { return edge + width * index; }
};

/// Readings of a target by one beam, averaged.
struct BeamAverage {
  std::size_t beam = 0;
  int readings = 1;
  double image_position = 0.0;  ///< [m]
  double current = 0.0;         ///< total photocurrent [A]
};

/// A flat target across the line of sight, that is at one depth of the sensor frame.
struct TargetPlacement {
  double depth = 0.0;              ///< [m], ahead of the origin of the sensor frame
  std::optional<Stripes> stripes;  ///< without any it is evenly bright
  std::vector<BeamAverage> beams;  ///< that saw it, rising
};

/// Recording of a sensor in a calibration rig (pears section 3.2): plain targets for the z table,
/// striped ones for the x calibration.
///
/// Its file is a config::CsvTable with one row for each placement and beam:
/// `target` (plain or striped), `depth_m`, `beam` (from 0), `readings`, `image_position_m`,
/// `current_A`; where there are striped targets also `stripe_edge_m` and `stripe_width_m`, which
/// plain ones leave empty. Rows may come in any order.
struct CalibrationRecording {
  std::vector<TargetPlacement> placements;
};

/// Throws config::Error with file, line and column; also for what that sensor cannot have recorded:
/// a beam it does not have, an image beyond its detector, a target behind its scan's origin.
CalibrationRecording readRecording(const config::CsvTable& table, const SensorParameters& sensor);

/// Writes CSV, to the last digit.
std::string toCsv(const CalibrationRecording& recording);

}  // namespace sightline::triangulation
