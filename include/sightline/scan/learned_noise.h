#pragma once

#include <cstddef>

#include "sightline/scan/noise_fit.h"
#include "sightline/scan/noise_histogram.h"
#include "sightline/scan/noise_model.h"
#include "sightline/scan/range_step.h"
#include "sightline/scan/scan.h"

namespace sightline::scan {

/// Noise along the beams of one scanner.
struct RangeNoise {
  double sigma = 0.01;           ///< constant part [m]; the noise of quantisation is in it
  double sigma_per_metre = 0.0;  ///< share of the range, added in quadrature
  double step = 0.0;             ///< in which the ranges are counted [m]; 0: none that matters
  bool is_learned = false;       ///< whether scans have shown it

  /// [m²]
  double variance(double range) const {
    const double growing = sigma_per_metre * range;
    return sigma * sigma + growing * growing;
  }
};

/// Learns the noise of one scanner from its first scans and keeps it: later scans change it slowly.
///
/// Each return is held against its neighbours (NoiseHistogram), and the noise is the narrow part of
/// what comes of it (fitNoise): steps, edges and furniture make distances of any size, and do not
/// raise it. Ranges counted in steps have the noise of the step at least.
class LearnedNoise {
 public:
  /// Uses sigma, which is assumed until enough has been seen, least_sigma and angular_sigma.
  explicit LearnedNoise(const NoiseModel& model = {});

  /// Learns from a scan and fills its variances. A scan whose own are known is not to be given.
  void apply(Scan& scan);
  const RangeNoise& noise() const { return noise_; }

 private:
  void learn(const Scan& scan);
  void fit();

  NoiseModel model_;
  RangeStep step_;
  NoiseHistogram histogram_;
  NoiseFit fit_;
  RangeNoise noise_;
  std::size_t scans_ = 0;
};

}  // namespace sightline::scan
