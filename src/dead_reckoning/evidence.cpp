#include "sightline/dead_reckoning/evidence.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

struct EvidenceTuning {
  // Distance of a point from its counterpart's line up to which it is one, at least [m] and in
  // standard deviations of a beam, and where it would cost as much as none, over that.
  double inlier = 0.08;
  double inlier_sigmas = 3.0;
  double truncation = 2.5;
  // Cost of a point without a counterpart where nobody could expect one, or where the reference has
  // a surface too rough to match with; and of a point of the reference that the scan looks through.
  // After a turn or a gap most points cost the first, so that right poses are refused.
  double unknown_cost = 0.5;
  double looked_through_cost = 0.5;
  // Residuals beyond this, in standard deviations, have next to no weight in the match.
  double outlier = 4.0;
  // Largest correlation of neighbours that is believed.
  double most_correlation = 0.9;
};
constexpr EvidenceTuning kEvidence{};

double costOf(Sight sight) {
  return sight == Sight::kFree ? 1.0 : kEvidence.unknown_cost;
}

// Sums over the points of a scan.
struct EvidenceSums {
  double inliers = 0.0;
  double contradictions = 0.0;
  double cost = 0.0;
  double known = 0.0;
  double known_cost = 0.0;

  void addInlier(double share) {
    inliers += 1.0;
    known += 1.0;
    cost += share;
    known_cost += share;
  }
  void addOther(Sight sight) {
    cost += costOf(sight);
    if (sight == Sight::kFree) contradictions += 1.0;
    if (sight != Sight::kFree && sight != Sight::kSurface) return;
    known += 1.0;
    known_cost += costOf(sight);
  }
};

// Points of the scanner's newest keyframe where the scan sees free space.
double lookedThrough(const Pose2& T_odom_base, const RangeProfile& profile, std::size_t scanner,
                     const Submap& submap) {
  const Keyframe* keyframe = submap.newestOf(scanner);
  if (keyframe == nullptr) return 0.0;
  const Pose2 T_base_keyframe = geometry::between(T_odom_base, keyframe->T_odom_base);
  const Eigen::Matrix2d rotation = T_base_keyframe.rotation();
  double count = 0.0;
  for (const SurfacePoint& point : keyframe->points) {
    const Eigen::Vector2d place = rotation * point.position + T_base_keyframe.translation();
    if (profile.at(place) == Sight::kFree) count += 1.0;
  }
  return count;
}

}  // namespace

Evidence weigh(const LineMatch& match, const SurfaceScan& surfaces, const RangeProfile& profile,
               const Submap& submap) {
  EvidenceSums sum;
  const double inlier = std::max(kEvidence.inlier, kEvidence.inlier_sigmas * surfaces.sigma);
  const double truncation = kEvidence.truncation * inlier;
  const Eigen::Matrix2d rotation = match.T_odom_base.rotation();
  for (std::size_t i = 0; i < surfaces.points.size(); ++i) {
    const double distance = match.distances[i];
    if (std::abs(distance) < inlier) {
      sum.addInlier(distance * distance / (truncation * truncation));
      continue;
    }
    sum.addOther(
        submap.sightOf(rotation * surfaces.points[i].position + match.T_odom_base.translation()));
  }
  const double through = lookedThrough(match.T_odom_base, profile, surfaces.scanner, submap);
  const double count = static_cast<double>(std::max<std::size_t>(1, surfaces.points.size()));
  const double spent = kEvidence.looked_through_cost * through;
  return {sum.inliers / count, (sum.contradictions + through) / count, (sum.cost + spent) / count,
          sum.known / count, (sum.known_cost + spent) / std::max(1.0, sum.known)};
}

ResidualStatistics residualStatistics(const LineMatch& match) {
  double count = 0.0;
  double squares = 0.0;
  double products = 0.0;
  double before = 0.0;
  for (const double residual : match.residuals) {
    if (!(std::abs(residual) < kEvidence.outlier)) {
      before = 0.0;
      continue;
    }
    count += 1.0;
    squares += residual * residual;
    products += residual * before;
    before = residual;
  }
  if (count < 4.0 || squares == 0.0) return {};
  return {squares / (count - 3.0), std::clamp(products / squares, 0.0, kEvidence.most_correlation)};
}

}  // namespace sightline::dead_reckoning
