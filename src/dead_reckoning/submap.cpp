#include "sightline/dead_reckoning/submap.h"

#include <cmath>

namespace sightline::dead_reckoning {

namespace {

// Cells lie on a torus: places a whole turn of 64 m apart share one, and are told apart by their
// distance.
constexpr std::uint32_t kSide = 256;
constexpr double kCellsPerMetre = 1.0 / Submap::kReach;
constexpr double kFacing = 0.7;  // least cosine between two normals of one surface

std::uint32_t coordinate(double metres) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(metres * kCellsPerMetre)));
}

std::uint32_t cell(std::uint32_t x, std::uint32_t y) {
  return (y % kSide) * kSide + x % kSide;
}

std::uint32_t cellOf(const Eigen::Vector2d& point) {
  return cell(coordinate(point.x()), coordinate(point.y()));
}

}  // namespace

void Submap::clear() {
  keyframes_.clear();
  sorted_.clear();
  begin_.clear();
}

void Submap::add(const geometry::Pose2& T_odom_base, const std::vector<SurfacePoint>& points,
                 std::size_t most) {
  const Eigen::Matrix2d rotation = T_odom_base.rotation();
  std::vector<Surfel> keyframe;
  keyframe.reserve(points.size());
  for (const SurfacePoint& point : points) {
    if (!point.hasNormal()) continue;
    keyframe.push_back({rotation * point.smoothed + T_odom_base.translation(),
                        rotation * point.normal, point.reach});
  }
  keyframes_.push_back(std::move(keyframe));
  while (keyframes_.size() > most) keyframes_.pop_front();
  rebuild();
}

// Counting sort by cell.
void Submap::rebuild() {
  begin_.assign(kSide * kSide + 1, 0);
  std::size_t total = 0;
  for (const auto& keyframe : keyframes_) {
    total += keyframe.size();
    for (const Surfel& surfel : keyframe) ++begin_[cellOf(surfel.position)];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : begin_) begin = sum += begin;
  sorted_.resize(total);
  for (const auto& keyframe : keyframes_) {
    for (const Surfel& surfel : keyframe) sorted_[--begin_[cellOf(surfel.position)]] = surfel;
  }
}

const Surfel* Submap::nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& normal) const {
  if (begin_.empty()) return nullptr;
  const bool any = normal.isZero(0.0);
  const Surfel* best = nullptr;
  double best_square = kReach * kReach;
  const std::uint32_t x = coordinate(point.x()) - 1;
  const std::uint32_t y = coordinate(point.y()) - 1;
  for (std::uint32_t dy = 0; dy < 3; ++dy) {
    for (std::uint32_t dx = 0; dx < 3; ++dx) {
      const std::uint32_t here = cell(x + dx, y + dy);
      for (std::uint32_t i = begin_[here]; i < begin_[here + 1]; ++i) {
        const Surfel& surfel = sorted_[i];
        const double square = (surfel.position - point).squaredNorm();
        if (square >= best_square) continue;
        if (!any && surfel.normal.dot(normal) < kFacing) continue;
        best_square = square;
        best = &surfel;
      }
    }
  }
  return best;
}

}  // namespace sightline::dead_reckoning
