#pragma once

#include <cstdint>
#include <random>

#include "sightline/simulation/optical_head.h"
#include "sightline/simulation/random_stream.h"
#include "sightline/triangulation/photocurrents.h"

namespace sightline::simulation {

/// The lateral-effect photodiode behind the lens, with its noise and, where one is given, its
/// bandwidth.
class Detector {
 public:
  /// `noise_current` I_n [A] and `length` P [m] as in pears eqs 1 and 2; `bandwidth` [Hz] of the
  /// one pole that both currents pass through, 0: none, at `sample_rate` [Hz].
  Detector(double noise_current, double length, double bandwidth, double sample_rate,
           std::uint64_t seed);

  /// One sample. The difference of the currents has noise of standard deviation I_n, which makes
  /// eq. 2, and so has their sum, independently, which does not move the image. With a bandwidth
  /// neighbouring samples share some of both, and of the light.
  triangulation::Photocurrents measure(const SpotImage& spot);

 private:
  double next(double before);

  double noise_current_;
  double length_;
  double memory_;  // of a sample in the next one, [0, 1)
  triangulation::Photocurrents light_;
  double difference_noise_ = 0.0;  // of unit variance
  double total_noise_ = 0.0;       // likewise
  bool is_first_ = true;
  RandomStream random_;
  std::normal_distribution<double> normal_;
};

}  // namespace sightline::simulation
