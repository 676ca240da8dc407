#pragma once

#include <cstdint>

namespace sightline::dead_reckoning {

enum class MatchState : std::uint8_t {
  /// Nothing to match with: the first scan, or the first after a reset; of several scanners, also
  /// one that looks where nobody has looked while another one holds the pose.
  kInitial = 0,
  kMatched = 1,  ///< the only one besides that which is not flagged
  kAmbiguous =
      2,  ///< several poses explain the scan as well as this one, or other sensors contradict
  kRecovered = 3,  ///< matched, but the pose before was bridged and turns out to have been wrong
  kFailed = 4,     ///< no pose explains the scan: bridged by the prior
  /// Matched, but along some direction next to nothing shows the motion, as in a bare corridor: it
  /// went on there as predicted, and may be far off.
  kUnbound = 5,
};

}  // namespace sightline::dead_reckoning
