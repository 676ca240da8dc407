#pragma once

#include <array>

#include "sightline/scan/noise_histogram.h"

namespace sightline::scan {

/// Maximum-likelihood noise of a histogram of distances: at each range a share of them is normal
/// with the variance `constant + growth r²`, and the others are of any size, each octave beyond the
/// noise as likely as the next. Expectation maximisation, with the shares by range.
class NoiseFit {
 public:
  double constant() const { return constant_; }  ///< [m²]
  double growth() const { return growth_; }      ///< [1]
  /// Distances that are noise.
  double normal() const { return normal_; }

  /// Starts anew from the constant noise that explains the distances at all ranges best.
  void start(const NoiseHistogram& histogram);
  /// Improves on what it has.
  void improve(const NoiseHistogram& histogram, int steps);

 private:
  struct Row;
  void step(const NoiseHistogram& histogram);
  void solve(const std::array<Row, NoiseHistogram::kRanges>& rows);

  double constant_ = 0.0;
  double growth_ = 0.0;
  double normal_ = 0.0;
  std::array<double, NoiseHistogram::kRanges> shares_{};  // of what is noise
};

}  // namespace sightline::scan
