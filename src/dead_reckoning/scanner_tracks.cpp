#include "sightline/dead_reckoning/scanner_tracks.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

// Time over which a change of velocity is averaged [s].
constexpr double kAccelerationTime = 0.15;

}  // namespace

Eigen::Vector3d ScannerTrack::accelerationTo(const Eigen::Vector3d& found, double elapsed) const {
  if (!is_moving) return Eigen::Vector3d::Zero();
  const double kept = std::exp(-elapsed / kAccelerationTime);
  return kept * acceleration + (1.0 - kept) * (found - twist) / elapsed;
}

const ScannerTrack* ScannerTracks::of(std::size_t scanner) const {
  const auto found = tracks_.find(scanner);
  return found == tracks_.end() ? nullptr : &found->second;
}

bool ScannerTracks::isHeldByOther(std::size_t scanner, double since) const {
  return std::any_of(tracks_.begin(), tracks_.end(), [=](const auto& entry) {
    const auto& [number, track] = entry;
    return number != scanner && track.is_held && track.time >= since;
  });
}

}  // namespace sightline::dead_reckoning
