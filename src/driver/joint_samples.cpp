#include "sightline/driver/joint_samples.h"

#include <algorithm>

namespace sightline::driver {

namespace {

constexpr double kInterval = 0.01;  // [s]

}  // namespace

std::vector<std::size_t> jointSamples(const std::vector<double>& angles, double previous,
                                      double sample_rate) {
  const std::size_t last = angles.size() - 1;
  const bool stands =
      std::all_of(angles.begin(), angles.end(), [&](double angle) { return angle == angles[0]; });
  std::vector<std::size_t> samples;
  if (stands && angles[0] != previous) samples.push_back(0);
  if (!stands) {
    const auto step = std::max<std::size_t>(1, static_cast<std::size_t>(kInterval * sample_rate));
    for (std::size_t i = 0; i < last; i += step) samples.push_back(i);
  }
  samples.push_back(last);
  return samples;
}

double jointRate(const std::vector<double>& angles, std::size_t sample, double sample_rate) {
  const auto reach =
      std::max<std::size_t>(1, static_cast<std::size_t>(0.5 * kInterval * sample_rate));
  const std::size_t from = sample - std::min(sample, reach);
  const std::size_t to = std::min(angles.size() - 1, sample + reach);
  if (from == to) return 0.0;
  return (angles[to] - angles[from]) * sample_rate / static_cast<double>(to - from);
}

}  // namespace sightline::driver
