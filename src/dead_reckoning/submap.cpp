#include "sightline/dead_reckoning/submap.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

// Cells lie on a torus: places a whole turn of 51 m apart share one, and are told apart by their
// distance.
constexpr std::int32_t kSide = 512;
constexpr double kCell = 0.1;    // [m]
constexpr double kFacing = 0.7;  // least cosine between two normals of one surface
// A surfel this near to an older one that faces the same way says nothing new.
constexpr double kSpacing = 0.04;  // [m]
constexpr double kSameFacing = 0.9;
// Keyframes are dropped this share of them at a time, as that means to build anew.
constexpr std::size_t kBatches = 4;

std::int32_t coordinate(double metres) {
  return static_cast<std::int32_t>(std::floor(metres / kCell));
}

std::size_t cell(std::int32_t x, std::int32_t y) {
  return static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)));
}

}  // namespace

void Submap::clear() {
  keyframes_.clear();
  rebuild();
}

double Submap::add(const geometry::Pose2& T_odom_base, const Sweep& sweep, std::size_t most) {
  const Eigen::Matrix2d rotation = T_odom_base.rotation();
  Keyframe keyframe{T_odom_base, rotation.transpose(), sweep.points, RangeProfile(sweep), {}};
  for (const SurfacePoint& point : sweep.points) {
    if (!point.hasNormal()) continue;
    keyframe.surfels.push_back({rotation * point.smoothed + T_odom_base.translation(),
                                rotation * point.normal, point.normal_variance, point.reach});
  }
  ++version_;
  if (first_.empty()) rebuild();
  double added = 0.0;
  for (const Surfel& surfel : keyframe.surfels) added += insert(surfel) ? 1.0 : 0.0;
  keyframes_.push_back(std::move(keyframe));
  if (keyframes_.size() > most) {
    while (keyframes_.size() > most - most / kBatches) keyframes_.pop_front();
    rebuild();
  }
  return added / static_cast<double>(std::max<std::size_t>(1, keyframes_.back().surfels.size()));
}

void Submap::rebuild() {
  ++version_;
  surfels_.clear();
  next_.clear();
  first_.assign(static_cast<std::size_t>(kSide) * kSide, -1);
  for (const Keyframe& keyframe : keyframes_) {
    for (const Surfel& surfel : keyframe.surfels) insert(surfel);
  }
}

bool Submap::insert(const Surfel& surfel) {
  const std::size_t here = cell(coordinate(surfel.position.x()), coordinate(surfel.position.y()));
  for (std::int32_t i = first_[here]; i >= 0; i = next_[static_cast<std::size_t>(i)]) {
    const Surfel& other = surfels_[static_cast<std::size_t>(i)];
    if ((other.position - surfel.position).squaredNorm() < kSpacing * kSpacing &&
        other.normal.dot(surfel.normal) > kSameFacing) {
      return false;
    }
  }
  next_.push_back(first_[here]);
  first_[here] = static_cast<std::int32_t>(surfels_.size());
  surfels_.push_back(surfel);
  return true;
}

// Ring by ring of cells about the point, until what was found is nearer than the next ring.
const Surfel* Submap::nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& normal,
                              double reach) const {
  if (surfels_.empty()) return nullptr;
  Nearest nearest{point, normal, normal.isZero(0.0) ? -1.0 : kFacing, reach * reach, nullptr};
  const std::int32_t x = coordinate(point.x());
  const std::int32_t y = coordinate(point.y());
  const double to_border = std::min({point.x() - x * kCell, (x + 1) * kCell - point.x(),
                                     point.y() - y * kCell, (y + 1) * kCell - point.y()});
  look(cell(x, y), nearest);
  for (std::int32_t ring = 1;; ++ring) {
    const double covered = to_border + (ring - 1) * kCell;
    if (covered * covered >= nearest.square) return nearest.surfel;
    for (std::int32_t i = -ring; i < ring; ++i) {
      look(cell(x + i, y - ring), nearest);
      look(cell(x - i, y + ring), nearest);
      look(cell(x - ring, y - i), nearest);
      look(cell(x + ring, y + i), nearest);
    }
  }
}

Sight Submap::sightOf(const Eigen::Vector2d& point) const {
  Sight sight = Sight::kUnknown;
  for (auto keyframe = keyframes_.rbegin(); keyframe != keyframes_.rend(); ++keyframe) {
    const Sight here =
        keyframe->profile.at(keyframe->R_base_odom * (point - keyframe->T_odom_base.translation()));
    if (here == Sight::kFree || here == Sight::kSurface) return here;
    if (here == Sight::kHidden) sight = here;
  }
  return sight;
}

void Submap::look(std::size_t cell, Nearest& nearest) const {
  for (std::int32_t i = first_[cell]; i >= 0; i = next_[static_cast<std::size_t>(i)]) {
    const Surfel& surfel = surfels_[static_cast<std::size_t>(i)];
    const double square = (surfel.position - nearest.point).squaredNorm();
    if (square >= nearest.square || surfel.normal.dot(nearest.normal) < nearest.facing) continue;
    nearest.square = square;
    nearest.surfel = &surfel;
  }
}

}  // namespace sightline::dead_reckoning
