#pragma once

#include <cstdint>

namespace sightline::dead_reckoning {

enum class MatchState : std::uint8_t {
  kInitial = 0,    ///< first scan, or first after a reset: nothing to match with
  kMatched = 1,    ///< the only one besides the first that is not flagged
  kAmbiguous = 2,  ///< several poses explain the scan as well as this one
  kRecovered = 3,  ///< matched, but the pose before was bridged and turns out to have been wrong
  kFailed = 4,     ///< no pose explains the scan: bridged by the prior
};

}  // namespace sightline::dead_reckoning
