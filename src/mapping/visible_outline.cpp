#include "visible_outline.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sightline::mapping {

namespace {

constexpr struct {
  int looks = 720;
  double farthest = 14.0;    // [m]
  double jump = 0.3;         // between two looks: the nearer one ends at an edge [m]
  std::size_t smoothed = 9;  // looks that a median is of
  double pillar = 0.9;       // width of a thing that stands free, at most [m]
  double mouth = 2.8;        // of an opening that is cut, at most [m]
  double depth = 0.5;        // behind a mouth, at least, in mouths
  double least_depth = 0.3;  // [m]
} kOutline{};

using Outline = std::vector<OutlinePoint>;

// Whether anything was met in a cell, or beside it: walls that are seen at a grazing angle are
// passed by as many rays as they end.
std::optional<Eigen::Vector2d> metAbout(const FacingImages& images, int x, int y) {
  for (const int dy : {0, -1, 1, -2, 2}) {
    for (const int dx : {0, -1, 1, -2, 2}) {
      if (!images.isInside(x + dx, y + dy) || !images.isMet(x + dx, y + dy)) continue;
      return images.toMap(Eigen::Vector2d(x + dx + 0.5, y + dy + 0.5));
    }
  }
  return std::nullopt;
}

OutlinePoint lookFrom(const FacingImages& images, const Eigen::Vector2d& from, double angle,
                      const TakenFloor& taken) {
  const Eigen::Vector2d step(0.5 * std::cos(angle), 0.5 * std::sin(angle));
  const int steps = static_cast<int>(2.0 * kOutline.farthest / images.cell());
  Eigen::Vector2d p = from;
  for (int i = 0; i < steps; ++i, p += step) {
    const int x = static_cast<int>(std::floor(p.x()));
    const int y = static_cast<int>(std::floor(p.y()));
    if (!images.isInside(x, y)) return {images.toMap(p), LookEnd::kUnseen};
    if (images.isSolid(x, y)) {
      return {images.toMap(Eigen::Vector2d(x + 0.5, y + 0.5)), LookEnd::kSolid};
    }
    if (taken.holds(x, y)) return {images.toMap(p), LookEnd::kOpen};
    if (images.isKnown(x, y)) continue;
    if (const auto met = metAbout(images, x, y)) return {*met, LookEnd::kSolid};
    return {images.toMap(p), LookEnd::kUnseen};
  }
  return {images.toMap(p), LookEnd::kOpen};
}

/// An outline about its place, whose points are taken out and replaced.
class OutlineTrimmer {
 public:
  OutlineTrimmer(Outline outline, const Eigen::Vector2d& place)
      : outline_(std::move(outline)), place_(place), kept_(outline_.size(), true) {}

  Outline trimmed() {
    smooth();
    dropPillars();
    compact();
    cutPockets();
    compact();
    return outline_;
  }

 private:
  std::size_t size() const { return outline_.size(); }
  const Eigen::Vector2d& at(std::size_t i) const { return outline_[i % size()].place; }
  double range(std::size_t i) const { return (at(i) - place_).norm(); }

  void compact() {
    Outline left;
    for (std::size_t i = 0; i < size(); ++i) {
      if (kept_[i]) left.push_back(outline_[i]);
    }
    outline_ = std::move(left);
    kept_.assign(size(), true);
  }

  // Puts each point at the median distance of those about it: corners stay, what sticks out goes.
  void smooth() {
    const Outline before = outline_;
    const std::size_t half = kOutline.smoothed / 2;
    for (std::size_t i = 0; i < size(); ++i) {
      if (before[i].end != LookEnd::kSolid) continue;
      std::vector<double> ranges;
      for (std::size_t k = 0; k < kOutline.smoothed; ++k) {
        ranges.push_back((before[(i + size() + k - half) % size()].place - place_).norm());
      }
      const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(half);
      std::nth_element(ranges.begin(), middle, ranges.end());
      outline_[i].place = place_ + *middle * (before[i].place - place_).normalized();
    }
  }

  // Looks that end nearer than those on both sides of them.
  void dropPillars() {
    for (std::size_t i = 0; i < size(); ++i) {
      if (range(i) - range(i + 1) < kOutline.jump) continue;
      for (std::size_t j = i + 1; j < i + size() / 4; ++j) {
        if ((at(j) - at(i + 1)).norm() > kOutline.pillar) break;
        if (range(j + 1) - range(j) < kOutline.jump) continue;
        for (std::size_t k = i + 1; k <= j; ++k) kept_[k % size()] = false;
        break;
      }
    }
  }

  // How far what is seen between two points lies beyond the line that joins them.
  double depthBetween(std::size_t i, std::size_t j) const {
    const Eigen::Vector2d along = (at(j) - at(i)).normalized();
    const Eigen::Vector2d outwards(along.y(), -along.x());
    double depth = 0.0;
    for (std::size_t k = i + 1; k < j; ++k) depth = std::max(depth, outwards.dot(at(k) - at(i)));
    return depth;
  }

  // The nearest point to an edge behind which looks go further, on the far side of the opening.
  std::optional<std::size_t> farSide(std::size_t i, int way) const {
    const auto n = static_cast<std::ptrdiff_t>(size());
    std::optional<std::size_t> best;
    double least = kOutline.mouth;
    for (std::ptrdiff_t step = 2; step < n / 2; ++step) {
      const auto j =
          static_cast<std::size_t>((static_cast<std::ptrdiff_t>(i) + n + way * step) % n);
      if (outline_[j].end != LookEnd::kSolid) continue;
      const double mouth = (at(j) - at(i)).norm();
      if (mouth >= least) continue;
      least = mouth;
      best = j;
    }
    return best;
  }

  void cutPockets() {
    for (std::size_t i = 0; i < size(); ++i) {
      if (!kept_[i] || outline_[i].end != LookEnd::kSolid) continue;
      if (range(i + 1) - range(i) > kOutline.jump) cut(i, farSide(i, 1), 1);
      if (range(i + size() - 1) - range(i) > kOutline.jump) cut(i, farSide(i, -1), -1);
    }
  }

  void cut(std::size_t i, const std::optional<std::size_t>& other, int way) {
    if (!other) return;
    const std::size_t from = way > 0 ? i : *other;
    std::size_t to = way > 0 ? *other : i;
    if (to < from) to += size();
    const double mouth = (at(to) - at(from)).norm();
    const double depth = depthBetween(from, to);
    if (depth < std::max(kOutline.least_depth, kOutline.depth * mouth)) return;
    for (std::size_t k = from + 1; k < to; ++k) kept_[k % size()] = false;
    outline_[from % size()].opens_after = true;
  }

  Outline outline_;
  Eigen::Vector2d place_;
  std::vector<bool> kept_;
};

}  // namespace

TakenFloor::TakenFloor(const FacingImages& images, const std::vector<RoomOutline>& rooms)
    : width_(static_cast<std::size_t>(images.width())),
      cells_(width_ * static_cast<std::size_t>(images.height()), 0) {
  for (const RoomOutline& room : rooms) {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
    Eigen::Vector2d high = -low;
    for (std::size_t i = 0; i < room.sides.size(); ++i) {
      const Eigen::Vector2d corner = images.toImage(room.side(i).start);
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    for (int y = std::max(0, static_cast<int>(low.y())); y < images.height() && y <= high.y();
         ++y) {
      for (int x = std::max(0, static_cast<int>(low.x())); x < images.width() && x <= high.x();
           ++x) {
        if (!room.contains(images.toMap(Eigen::Vector2d(x + 0.5, y + 0.5)))) continue;
        cells_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)] = 1;
      }
    }
  }
}

std::vector<OutlinePoint> outlineAbout(const FacingImages& images, const Eigen::Vector2d& place_map,
                                       const TakenFloor& taken) {
  const Eigen::Vector2d from = images.toImage(place_map);
  Outline outline;
  for (int i = 0; i < kOutline.looks; ++i) {
    outline.push_back(lookFrom(images, from, 2.0 * geometry::kPi * i / kOutline.looks, taken));
  }
  return OutlineTrimmer(std::move(outline), place_map).trimmed();
}

}  // namespace sightline::mapping
