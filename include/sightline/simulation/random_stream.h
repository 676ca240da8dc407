#pragma once

#include <cstdint>
#include <random>

namespace sightline::simulation {

/// Independent random numbers for each consumer, so that what one of them draws, or how often, does
/// not change what another one gets.
using RandomStream = std::mt19937_64;

RandomStream randomStream(std::uint64_t seed, std::uint64_t consumer);

}  // namespace sightline::simulation
