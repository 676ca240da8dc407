#include "sightline/dead_reckoning/submap.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

struct SubmapTuning {
  // Cells on a side, and their size [m]. They lie on a torus: places a whole turn of 51 m apart
  // share one, and are told apart by their distance.
  std::int32_t side = 512;
  double cell = 0.1;
  // Least cosine between two normals of one surface. One that no pair reaches makes matching
  // impossible; others make no difference on fr079 and the Intel log.
  double facing = 0.7;
  // A surfel this near [m] to an older one that faces the same way says nothing new. Twice the
  // distance costs 3.5 points of bad steps on a scanner of 5 cm counts (aces).
  double spacing = 0.04;
  double same_facing = 0.9;
  // Share of the keyframes that are dropped at a time, as that means to build anew.
  std::size_t batches = 4;
  // Newest keyframes that are asked what a place is, however many there are.
  std::ptrdiff_t asked = 50;
};
constexpr SubmapTuning kSubmap{};

std::int32_t coordinate(double metres) {
  return static_cast<std::int32_t>(std::floor(metres / kSubmap.cell));
}

std::size_t cell(std::int32_t x, std::int32_t y) {
  return static_cast<std::size_t>((y & (kSubmap.side - 1)) * kSubmap.side +
                                  (x & (kSubmap.side - 1)));
}

}  // namespace

void Submap::clear() {
  keyframes_.clear();
  rebuild();
}

double Submap::add(const geometry::Pose2& T_odom_base, const SurfaceScan& surfaces,
                   std::size_t most) {
  const Eigen::Matrix2d rotation = T_odom_base.rotation();
  Keyframe keyframe{surfaces.scanner,       T_odom_base, rotation.transpose(), surfaces.points,
                    RangeProfile(surfaces), {}};
  for (const SurfacePoint& point : surfaces.points) {
    if (!point.hasNormal()) continue;
    keyframe.surfels.push_back({rotation * point.smoothed + T_odom_base.translation(),
                                rotation * point.normal, point.normal_variance, point.reach});
  }
  ++version_;
  if (first_.empty()) rebuild();
  double added = 0.0;
  for (const Surfel& surfel : keyframe.surfels) added += insert(surfel) ? 1.0 : 0.0;
  const double surfels = static_cast<double>(std::max<std::size_t>(1, keyframe.surfels.size()));
  for (Keyframe& other : keyframes_) compare(other, keyframe);
  keyframes_.push_back(std::move(keyframe));
  const bool is_misplaced = keyframes_.back().isMisplaced();
  const bool are_many = keyframes_.size() > most;
  if (are_many) {
    while (keyframes_.size() > most - most / kSubmap.batches) keyframes_.pop_front();
  }
  if (takeOutMisplaced() || are_many) rebuild();
  return is_misplaced ? 0.0 : added / surfels;
}

// Of two that contradict each other, the one that more others contradict is wrong. Where all do,
// none is known to be.
bool Submap::takeOutMisplaced() {
  const auto first = std::remove_if(keyframes_.begin(), keyframes_.end(),
                                    [](const Keyframe& each) { return each.isMisplaced(); });
  if (first == keyframes_.begin() || first == keyframes_.end()) return false;
  keyframes_.erase(first, keyframes_.end());
  return true;
}

void Submap::rebuild() {
  ++version_;
  surfels_.clear();
  next_.clear();
  first_.assign(static_cast<std::size_t>(kSubmap.side) * kSubmap.side, -1);
  for (const Keyframe& keyframe : keyframes_) {
    for (const Surfel& surfel : keyframe.surfels) insert(surfel);
  }
}

bool Submap::insert(const Surfel& surfel) {
  const std::size_t here = cell(coordinate(surfel.position.x()), coordinate(surfel.position.y()));
  for (std::int32_t i = first_[here]; i >= 0; i = next_[static_cast<std::size_t>(i)]) {
    const Surfel& other = surfels_[static_cast<std::size_t>(i)];
    if ((other.position - surfel.position).squaredNorm() < kSubmap.spacing * kSubmap.spacing &&
        other.normal.dot(surfel.normal) > kSubmap.same_facing) {
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
  Nearest nearest{point, normal, normal.isZero(0.0) ? -1.0 : kSubmap.facing, reach * reach,
                  nullptr};
  const std::int32_t x = coordinate(point.x());
  const std::int32_t y = coordinate(point.y());
  const double to_border =
      std::min({point.x() - x * kSubmap.cell, (x + 1) * kSubmap.cell - point.x(),
                point.y() - y * kSubmap.cell, (y + 1) * kSubmap.cell - point.y()});
  look(cell(x, y), nearest);
  for (std::int32_t ring = 1;; ++ring) {
    const double covered = to_border + (ring - 1) * kSubmap.cell;
    if (covered * covered >= nearest.square) return nearest.surfel;
    for (std::int32_t i = -ring; i < ring; ++i) {
      look(cell(x + i, y - ring), nearest);
      look(cell(x - i, y + ring), nearest);
      look(cell(x - ring, y - i), nearest);
      look(cell(x + ring, y + i), nearest);
    }
  }
}

const Keyframe* Submap::newestOf(std::size_t scanner) const {
  const auto found =
      std::find_if(keyframes_.rbegin(), keyframes_.rend(),
                   [=](const Keyframe& keyframe) { return keyframe.scanner == scanner; });
  return found == keyframes_.rend() ? nullptr : &*found;
}

Sight Submap::sightOf(const Eigen::Vector2d& point) const {
  Sight sight = Sight::kUnknown;
  const auto count = static_cast<std::ptrdiff_t>(keyframes_.size());
  const auto end = keyframes_.rbegin() + std::min(kSubmap.asked, count);
  for (auto keyframe = keyframes_.rbegin(); keyframe != end; ++keyframe) {
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
