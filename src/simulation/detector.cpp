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

// Noise of unit variance, sharing as much with the one before as the bandwidth lets.
double Detector::next(double before) {
  const double fresh = normal_(random_);
  return is_first_ ? fresh : memory_ * before + std::sqrt(1.0 - memory_ * memory_) * fresh;
}

triangulation::Photocurrents Detector::measure(const SpotImage& spot) {
  const auto now = triangulation::photocurrentsAt(spot.image_position, spot.current, length_);
  const double kept = is_first_ ? 0.0 : memory_;
  light_.first = kept * light_.first + (1.0 - kept) * now.first;
  light_.second = kept * light_.second + (1.0 - kept) * now.second;
  difference_noise_ = next(difference_noise_);
  total_noise_ = next(total_noise_);
  is_first_ = false;
  const double total = light_.total();
  const double place = total > 0.0 ? (light_.first - light_.second) / total : 0.0;
  // Noise of the total falls on the same place.
  const double more = noise_current_ * total_noise_;
  const double difference = place * (total + more) + noise_current_ * difference_noise_;
  return {0.5 * (total + more + difference), 0.5 * (total + more - difference)};
}

}  // namespace sightline::simulation
