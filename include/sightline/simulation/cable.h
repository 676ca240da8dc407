#pragma once

#include <cstdint>
#include <vector>

#include "sightline/simulation/random_stream.h"

namespace sightline::simulation {

/// Faults of a cable and its adapters.
struct CableFaults {
  double corrupted = 0.0;  ///< share of the bytes that arrive as others
  double dropped = 0.0;    ///< share of the bytes that do not arrive
  double bursts = 0.0;     ///< share of the frames in which 1 to 64 bytes in a row are garbage
  double delay = 0.0;      ///< of everything, either way [s]
  double jitter = 0.0;     ///< on top: uniform from nothing to this, of each frame [s]
};

class Cable {
 public:
  explicit Cable(std::uint64_t seed) : random_(randomStream(seed, 1)) {}

  void setFaults(const CableFaults& faults) { faults_ = faults; }
  /// Whether the bytes came through as they were.
  bool pass(std::vector<std::uint8_t>& bytes);
  /// Delay of the next frame [ns].
  std::int64_t delay();

 private:
  bool happens(double share);
  bool burst(std::vector<std::uint8_t>& bytes);
  bool corrupt(std::vector<std::uint8_t>& bytes);
  bool drop(std::vector<std::uint8_t>& bytes);

  CableFaults faults_;
  RandomStream random_;
};

}  // namespace sightline::simulation
