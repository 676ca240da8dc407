#include "sightline/dead_reckoning/range_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::dead_reckoning {

namespace {

struct ProfileTuning {
  // Errors of pose and surface that are allowed for: a part that does not depend on the range [m],
  // and one that grows with it as an error of the heading does [m/m].
  double margin = 0.12;
  double margin_per_metre = 0.03;
};
constexpr ProfileTuning kProfile{};

// Bins go round the diamond |x| + |y| = 1 instead of the circle, which takes no arc tangent; they
// are up to a third narrower or wider than if they were even.
std::size_t binOf(const Eigen::Vector2d& direction, std::size_t bins) {
  const double sum = std::abs(direction.x()) + std::abs(direction.y());
  if (sum == 0.0) return 0;
  const double along = direction.x() / sum;
  const double quarters = direction.y() >= 0.0 ? 1.0 - along : 3.0 + along;  // [0, 4)
  return static_cast<std::size_t>(0.25 * quarters * static_cast<double>(bins)) % bins;
}

}  // namespace

RangeProfile::RangeProfile() {
  nearest_.fill(std::numeric_limits<float>::infinity());
  farthest_.fill(-1.0F);
}

RangeProfile::RangeProfile(const SurfaceScan& surfaces) : RangeProfile() {
  sensor_ = surfaces.sensor;
  for (const SurfacePoint& point : surfaces.points) {
    const Eigen::Vector2d beam = point.position - sensor_;
    const auto range = static_cast<float>(beam.norm());
    const std::size_t bin = binOf(beam, kBins);
    for (const std::size_t near : {bin + kBins - 1, bin, bin + 1}) {
      nearest_[near % kBins] = std::min(nearest_[near % kBins], range);
      farthest_[near % kBins] = std::max(farthest_[near % kBins], range);
    }
  }
}

Sight RangeProfile::at(const Eigen::Vector2d& point_base) const {
  const Eigen::Vector2d beam = point_base - sensor_;
  const std::size_t bin = binOf(beam, kBins);
  if (farthest_[bin] < 0.0F) return Sight::kUnknown;
  const double range = beam.norm();
  const double margin = kProfile.margin + kProfile.margin_per_metre * range;
  if (range < static_cast<double>(nearest_[bin]) - margin) return Sight::kFree;
  if (range > static_cast<double>(farthest_[bin]) + margin) return Sight::kHidden;
  return Sight::kSurface;
}

}  // namespace sightline::dead_reckoning
