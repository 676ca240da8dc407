#pragma once

#include <cstddef>
#include <vector>

#include "sightline/config/node.h"

namespace sightline::triangulation {

/// The z calibration table (pears section 3.2): where on the detector a flat target appeared, for
/// every beam and for targets at several depths. Depth is found from image position by
/// interpolation in it; nothing is assumed of the sensor but that nearer means further along the
/// detector.
class CalibrationTable {
 public:
  enum class Reach {
    kWithin,
    kNearer,   ///< than the nearest target that this beam saw
    kFarther,  ///< than the farthest
  };
  struct Lookup {
    Reach reach = Reach::kWithin;
    double depth = 0.0;  ///< [m]; of the table's end where beyond it
    double gain = 0.0;   ///< ∂z/∂p [1], never positive
  };

  /// Depths [m] of the targets in the sensor frame, positive and rising; for each beam one image
  /// position [m] a depth, falling. NaN where a target was not on the detector: only at either end
  /// of a beam's row, of which at least two have to be left. Throws config::Error that names
  /// `source`, and the beam.
  CalibrationTable(std::vector<double> depths, std::vector<std::vector<double>> image_positions,
                   const std::string& source = "");

  /// `{depths: [...], image_positions: [[...], ...]}`, in metres. Throws config::Error.
  explicit CalibrationTable(const config::Node& node);

  std::size_t beams() const { return rows_.size(); }
  const std::vector<double>& depths() const { return depths_; }
  /// Image positions as given, NaN included.
  std::vector<double> imagePositions(std::size_t beam) const;

  /// Depth of an image position. Between two depths, 1/z is linear in p: that it would be for a
  /// sensor whose lens and laser turn about one axis, and is nearly so for this one.
  Lookup lookUp(std::size_t beam, double image_position) const;

 private:
  // Targets first, first + 1, ... of one beam: image positions negated, so that they rise.
  struct Row {
    std::size_t first = 0;
    std::vector<double> negated;
  };
  static CalibrationTable fromNode(const config::Node& node);
  static Row rowOf(const std::vector<double>& image_positions);

  std::vector<double> depths_;
  std::vector<double> inverse_depths_;
  std::vector<Row> rows_;
};

}  // namespace sightline::triangulation
