#pragma once

#include <cstddef>
#include <vector>

namespace sightline::driver {

/// The samples of a scan whose head angles tell how the head turned: the last one, the first one
/// unless the head is where it was before the scan, and every hundredth of a second while it turns.
/// Between two of these a servo with 30 rad/s² leaves the straight line by 0.02°.
///
/// @param angles    at each sample, at least one
/// @param previous  of the sample before
std::vector<std::size_t> jointSamples(const std::vector<double>& angles, double previous,
                                      double sample_rate);

/// Rate of the head [rad/s] about a sample: over a hundredth of a second, as far as the scan goes.
double jointRate(const std::vector<double>& angles, std::size_t sample, double sample_rate);

}  // namespace sightline::driver
