#pragma once

#include <vector>

#include "sightline/config/csv_table.h"

namespace sightline::triangulation {

/// Spread of repeated readings of one target.
struct SpreadAtCurrent {
  double current = 0.0;               ///< mean total photocurrent [A]
  double image_position_sigma = 0.0;  ///< standard deviation of one reading [m]
};

/// Columns `current_A` or `current_nA`, and `image_sigma_m` or `image_sigma_um`. Throws
/// config::Error with file, line and column.
std::vector<SpreadAtCurrent> readSpreads(const config::CsvTable& table);

/// Outcome of least squares on log Δp against log I₀ (pears eq. 2).
struct NoiseCurrentEstimate {
  /// Δp · I₀ [m·A], with the slope held at the −1 that eq. 2 says.
  double product = 0.0;
  double product_sigma = 0.0;  ///< from the scatter of the readings
  /// The same with the slope left free, which tells whether eq. 2 holds: Δp · I₀ at 1 nA [m·A], and
  /// the slope, −1 within a few of its standard deviations if it does.
  double free_product = 0.0;
  double free_slope = 0.0;
  double free_slope_sigma = 0.0;

  /// I_n [A] and its standard deviation for a detector of P = `detector_length` [m].
  double noiseCurrent(double detector_length) const { return product / (0.5 * detector_length); }
  double noiseCurrentSigma(double detector_length) const {
    return product_sigma / (0.5 * detector_length);
  }
};

/// Throws config::Error naming `source` for fewer than three readings, or where all have the same
/// current: then nothing tells of the slope.
NoiseCurrentEstimate estimateNoiseCurrent(const std::vector<SpreadAtCurrent>& spreads,
                                          const std::string& source = "");

}  // namespace sightline::triangulation
