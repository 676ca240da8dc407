#include "sightline/simulation/detector.h"

#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::simulation {

Detector::Detector(double noise_current, double length, double bandwidth, double sample_rate,
                   std::uint64_t seed)
    : noise_current_(noise_current),
      length_(length),
      memory_(bandwidth > 0.0 ? std::exp(-2.0 * geometry::kPi * bandwidth / sample_rate) : 0.0),
      random_(randomStream(seed, 2)) {}

double Detector::nextNoise() {
  const double fresh = normal_(random_);
  noise_ = is_first_ ? fresh : memory_ * noise_ + std::sqrt(1.0 - memory_ * memory_) * fresh;
  return noise_;
}

triangulation::Photocurrents Detector::measure(const SpotImage& spot) {
  const auto now = triangulation::photocurrentsAt(spot.image_position, spot.current, length_);
  const double kept = is_first_ ? 0.0 : memory_;
  light_.first = kept * light_.first + (1.0 - kept) * now.first;
  light_.second = kept * light_.second + (1.0 - kept) * now.second;
  const double noise = 0.5 * noise_current_ * nextNoise();
  is_first_ = false;
  return {light_.first + noise, light_.second - noise};
}

}  // namespace sightline::simulation
