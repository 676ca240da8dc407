#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/surface_points.h"

namespace sightline::dead_reckoning {

/// Relation of a place to a scanner that looks towards it.
enum class Sight : std::uint8_t {
  kUnknown,  ///< no beam went there
  kFree,     ///< beams passed through
  kSurface,  ///< beams ended there
  kHidden,   ///< behind where they ended
};

/// Ranges of a scan in each direction.
class RangeProfile {
 public:
  RangeProfile();
  explicit RangeProfile(const SurfaceScan& surfaces);

  Sight at(const Eigen::Vector2d& point_base) const;

 private:
  static constexpr std::size_t kBins = 256;  // over the full turn: wider than beams are apart

  Eigen::Vector2d sensor_ = Eigen::Vector2d::Zero();
  std::array<float, kBins> nearest_;   // over a bin and its neighbours [m]; infinite where empty
  std::array<float, kBins> farthest_;  // [m]; negative where empty
};

}  // namespace sightline::dead_reckoning
