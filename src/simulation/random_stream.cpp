#include "sightline/simulation/random_stream.h"

namespace sightline::simulation {

RandomStream randomStream(std::uint64_t seed, std::uint64_t consumer) {
  std::seed_seq words{seed & 0xffffffffu, seed >> 32, consumer & 0xffffffffu, consumer >> 32};
  return RandomStream(words);
}

}  // namespace sightline::simulation
