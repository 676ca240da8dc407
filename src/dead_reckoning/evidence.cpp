#include "sightline/dead_reckoning/evidence.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

constexpr double kInlier = 0.08;     // [m]
constexpr double kTruncation = 0.2;  // [m]
// What a point without a counterpart costs where nobody could expect one, and where the reference
// has a surface too rough to match with.
constexpr double kUnknownCost = 0.5;
// Of a point of the reference that the scan looks through.
constexpr double kLookedThroughCost = 0.5;

double costOf(Sight sight) {
  return sight == Sight::kFree ? 1.0 : kUnknownCost;
}

// Points of the newest keyframe where the scan sees free space.
double lookedThrough(const Pose2& T_odom_base, const RangeProfile& profile, const Submap& submap) {
  const Keyframe& keyframe = submap.keyframes().back();
  const Pose2 T_base_keyframe = geometry::between(T_odom_base, keyframe.T_odom_base);
  const Eigen::Matrix2d rotation = T_base_keyframe.rotation();
  double count = 0.0;
  for (const SurfacePoint& point : keyframe.points) {
    const Eigen::Vector2d place = rotation * point.position + T_base_keyframe.translation();
    if (profile.at(place) == Sight::kFree) count += 1.0;
  }
  return count;
}

}  // namespace

Evidence weigh(const LineMatch& match, const Sweep& sweep, const RangeProfile& profile,
               const Submap& submap) {
  Evidence sum{0.0, 0.0, 0.0};
  const Eigen::Matrix2d rotation = match.T_odom_base.rotation();
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const double distance = match.distances[i];
    if (std::abs(distance) < kInlier) {
      sum.inliers += 1.0;
      sum.cost += distance * distance / (kTruncation * kTruncation);
      continue;
    }
    const Sight sight =
        submap.sightOf(rotation * sweep.points[i].position + match.T_odom_base.translation());
    sum.cost += costOf(sight);
    if (sight == Sight::kFree) sum.contradictions += 1.0;
  }
  const double through = lookedThrough(match.T_odom_base, profile, submap);
  const double count = static_cast<double>(std::max<std::size_t>(1, sweep.points.size()));
  return {sum.inliers / count, (sum.contradictions + through) / count,
          (sum.cost + kLookedThroughCost * through) / count};
}

ResidualSpread spreadOf(const LineMatch& match) {
  double count = 0.0;
  double squares = 0.0;
  double products = 0.0;
  double before = 0.0;
  for (const double residual : match.residuals) {
    // Outliers have next to no weight in the match.
    if (!(std::abs(residual) < 4.0)) {
      before = 0.0;
      continue;
    }
    count += 1.0;
    squares += residual * residual;
    products += residual * before;
    before = residual;
  }
  if (count < 4.0 || squares == 0.0) return {};
  return {squares / (count - 3.0), std::clamp(products / squares, 0.0, 0.9)};
}

}  // namespace sightline::dead_reckoning
