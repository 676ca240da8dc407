#include "sightline/dead_reckoning/range_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sightline/geometry/angle.h"

namespace sightline::dead_reckoning {

namespace {

// What pose and surface may be off: a part that does not depend on the range, and one that grows
// with it as an error of the heading does.
constexpr double kMargin = 0.12;  // [m]
constexpr double kMarginPerMetre = 0.03;

std::size_t binOf(const Eigen::Vector2d& direction, std::size_t bins) {
  const double turn = std::atan2(direction.y(), direction.x()) / (2.0 * geometry::kPi);
  return static_cast<std::size_t>((turn + 1.0) * static_cast<double>(bins)) % bins;
}

}  // namespace

RangeProfile::RangeProfile() {
  nearest_.fill(std::numeric_limits<float>::infinity());
  farthest_.fill(-1.0F);
}

RangeProfile::RangeProfile(const Sweep& sweep) : RangeProfile() {
  sensor_ = sweep.sensor;
  for (const SurfacePoint& point : sweep.points) {
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
  const double margin = kMargin + kMarginPerMetre * range;
  if (range < static_cast<double>(nearest_[bin]) - margin) return Sight::kFree;
  if (range > static_cast<double>(farthest_[bin]) + margin) return Sight::kHidden;
  return Sight::kSurface;
}

}  // namespace sightline::dead_reckoning
