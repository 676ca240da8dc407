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

}  // namespace sightline::driver
