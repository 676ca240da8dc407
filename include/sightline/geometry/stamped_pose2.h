#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>

#include "sightline/geometry/pose2.h"

namespace sightline::geometry {

/// Pose of something at one time.
struct StampedPose2 {
  std::int64_t stamp = 0;  ///< [ns]
  Pose2 pose;
};

/// Ratio of the time from one stamp (0) to a later one (1) that has passed.
inline double ratioBetween(std::int64_t before, std::int64_t after, std::int64_t stamp) {
  return static_cast<double>(stamp - before) / static_cast<double>(after - before);
}

/// The first sample at or after a time, of samples in the order of their stamps.
template <class Iterator>
Iterator firstFrom(Iterator first, Iterator end, std::int64_t stamp) {
  return std::lower_bound(
      first, end, stamp, [](const auto& sample, std::int64_t time) { return sample.stamp < time; });
}

/// The pose at a time between two samples, by constant body velocity; nothing before the first
/// sample, after the last, or in a gap longer than `widest_gap` [ns].
template <class Iterator>
std::optional<Pose2> poseAt(Iterator first, Iterator end, std::int64_t stamp,
                            std::int64_t widest_gap) {
  const Iterator after = firstFrom(first, end, stamp);
  if (after == end) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == first) return std::nullopt;
  const Iterator before = std::prev(after);
  if (after->stamp - before->stamp > widest_gap) return std::nullopt;
  return interpolate(before->pose, after->pose, ratioBetween(before->stamp, after->stamp, stamp));
}

}  // namespace sightline::geometry
