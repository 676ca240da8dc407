#include "sightline/mapping/facing_images.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double cell = 0.05;        // at least [m]
  double most_cells = 16e6;  // of an image: a building of 200 m by 200 m
  double margin = 1.0;       // about all that was met [m]
  double facing = 0.94;      // least cosine between a surface's normal and its way: 20°
  double reach = 0.15;       // of a surface beside its beam, at most [m]
  double before_end = 0.12;  // a ray says nothing about the last bit of its way [m]
  int least_hits = 2;        // key scans that saw a wall
  // A wall of which fewer than this share of rays ends there is a thing that moved.
  double least_share = 0.2;
  int least_passes = 2;
  double far = 0.01;  // share of the points that are outliers on each side
} kImages{};

constexpr struct {
  std::size_t most = 3;
  double apart = 0.14;        // 8° [rad]
  double least_share = 0.08;  // of all length, within 1.5° of a further direction
} kDirections{};

double quantileOf(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

FacingImages::FacingImages(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses,
                           double turn)
    : turn_(turn), R_image_map_(Pose2(0.0, 0.0, -turn).rotation()), cell_(kImages.cell) {
  findExtent(keys, poses);
  const std::size_t cells = static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]);
  for (auto& image : hits_) image.assign(cells, 0);
  for (auto& image : last_) image.assign(cells, -1);
  passes_.assign(cells, 0);
  ends_.assign(cells, 0);
  for (std::size_t i = 0; i < keys.size(); ++i) draw(keys[i], poses[i], static_cast<int>(i));
  conclude();
}

// The path and all points but the farthest few, which are seen through windows.
void FacingImages::findExtent(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  std::vector<double> along[2];
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Eigen::Vector2d here = R_image_map_ * poses[i].translation();
    low = low.cwiseMin(here);
    high = high.cwiseMax(here);
    for (std::size_t j = 0; j < keys[i].surfaces.points.size(); j += 4) {
      const Eigen::Vector2d p = R_image_map_ * (poses[i] * keys[i].surfaces.points[j].position);
      for (int axis = 0; axis < 2; ++axis) along[axis].push_back(p[axis]);
    }
  }
  for (int axis = 0; axis < 2 && !along[0].empty(); ++axis) {
    low[axis] = std::min(low[axis], quantileOf(along[axis], kImages.far));
    high[axis] = std::max(high[axis], quantileOf(along[axis], 1.0 - kImages.far));
  }
  origin_ = low.array() - kImages.margin;
  const Eigen::Vector2d extent = (high - low).array() + 2.0 * kImages.margin;
  cell_ = std::max(kImages.cell, std::sqrt(extent.x() * extent.y() / kImages.most_cells));
  for (const int axis : {0, 1}) {
    size_[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(extent[axis] / cell_));
  }
}

Eigen::Vector2d FacingImages::toImage(const Eigen::Vector2d& point_map) const {
  return (R_image_map_ * point_map - origin_) / cell_;
}

Eigen::Vector2d FacingImages::toMap(const Eigen::Vector2d& cells) const {
  return R_image_map_.transpose() * (cells * cell_ + origin_);
}

void FacingImages::draw(const KeyScan& key, const Pose2& pose, int number) {
  const Eigen::Vector2d eye = toImage(pose * key.surfaces.sensor);
  for (const auto& point : key.surfaces.points) {
    drawRay(eye, toImage(pose * point.position), kImages.before_end / cell_);
    drawSurface(point, pose, number);
  }
  for (const Eigen::Vector2d& miss : key.misses) drawRay(eye, toImage(pose * miss), 0.0);
}

// Steps of a cell along the ray.
void FacingImages::drawRay(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double end) {
  const double length = (to - from).norm();
  if (length < 1e-6) return;
  const Eigen::Vector2d step = (to - from) / length;
  const int steps = static_cast<int>(length - end);
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector2d p = from + i * step;
    const int x = static_cast<int>(std::floor(p.x()));
    const int y = static_cast<int>(std::floor(p.y()));
    if (!isInside(x, y)) return;
    std::uint16_t& passes = passes_[at(x, y)];
    if (passes < std::numeric_limits<std::uint16_t>::max()) ++passes;
  }
}

// A surface of a cell's length counts once for each key scan that sees it.
void FacingImages::drawSurface(const dead_reckoning::SurfacePoint& point, const Pose2& pose,
                               int number) {
  const Eigen::Vector2d centre = toImage(pose * point.position);
  const int x = static_cast<int>(std::floor(centre.x()));
  const int y = static_cast<int>(std::floor(centre.y()));
  if (!isInside(x, y)) return;
  ++ends_[at(x, y)];
  if (!point.hasNormal()) return;
  const Eigen::Vector2d normal = R_image_map_ * (pose.rotation() * point.normal);
  const int axis = std::abs(normal.x()) > std::abs(normal.y()) ? 0 : 1;
  if (std::abs(normal[axis]) < kImages.facing) return;
  const auto facing = static_cast<std::size_t>(axis + (normal[axis] < 0.0 ? 2 : 0));
  const double reach = std::min(point.reach, kImages.reach) / cell_;
  const int from = static_cast<int>(std::floor(centre[1 - axis] - reach));
  const int to = static_cast<int>(std::floor(centre[1 - axis] + reach));
  for (int i = from; i <= to; ++i) {
    const int cx = axis == 0 ? x : i;
    const int cy = axis == 0 ? i : y;
    if (!isInside(cx, cy) || last_[facing][at(cx, cy)] == number) continue;
    last_[facing][at(cx, cy)] = number;
    ++hits_[facing][at(cx, cy)];
  }
}

void FacingImages::conclude() {
  for (std::size_t f = 0; f < walls_.size(); ++f) {
    walls_[f].resize(passes_.size());
    for (std::size_t i = 0; i < passes_.size(); ++i) {
      const int hits = hits_[f][i];
      walls_[f][i] = hits >= kImages.least_hits && hits > kImages.least_share * passes_[i];
    }
  }
  solid_.resize(passes_.size());
  free_.resize(passes_.size());
  known_.resize(passes_.size());
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    free_[i] = passes_[i] >= kImages.least_passes && kImages.least_share * passes_[i] > ends_[i];
    solid_[i] = ends_[i] >= kImages.least_hits && ends_[i] > kImages.least_share * passes_[i];
    known_[i] = passes_[i] > 0 || ends_[i] > 0;
  }
  last_ = {};
  hits_ = {};
}

namespace {

// A piece of surface: which way it faces, modulo 90° [rad], and its length [m].
struct Facing {
  double direction;
  double length;
};

std::vector<Facing> facingsOf(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses) {
  std::vector<Facing> facings;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    for (const auto& point : keys[i].surfaces.points) {
      if (!point.hasNormal()) continue;
      const double angle = std::atan2(point.normal.y(), point.normal.x()) + poses[i].theta();
      const double folded = angle - 0.5 * geometry::kPi * std::floor(angle / (0.5 * geometry::kPi));
      facings.push_back({folded, std::min(point.reach, kImages.reach)});
    }
  }
  return facings;
}

double meanAbout(const std::vector<Facing>& facings, double best) {
  constexpr double kNear = 0.1;
  std::complex<double> sum = 0.0;
  for (const Facing& facing : facings) {
    if (std::abs(std::remainder(facing.direction - best, 0.5 * geometry::kPi)) < kNear) {
      sum += std::polar(facing.length, 4.0 * facing.direction);
    }
  }
  const double mean = 0.25 * std::arg(sum);
  return mean < 0.0 ? mean + 0.5 * geometry::kPi : mean;
}

}  // namespace

std::vector<double> mainDirections(const std::vector<KeyScan>& keys,
                                   const std::vector<Pose2>& poses) {
  const std::vector<Facing> facings = facingsOf(keys, poses);
  std::vector<double> histogram(90, 0.0);  // by degree
  double all = 0.0;
  for (const Facing& facing : facings) {
    histogram[static_cast<std::size_t>(geometry::degrees(facing.direction)) % 90] += facing.length;
    all += facing.length;
  }
  std::vector<double> directions;
  while (directions.size() < kDirections.most) {
    double best = 0.0;
    double most = -1.0;
    for (std::size_t i = 0; i < 90; ++i) {
      const double here = geometry::radians(static_cast<double>(i) + 0.5);
      const double sum = histogram[(i + 89) % 90] + histogram[i] + histogram[(i + 1) % 90];
      const bool is_apart = std::all_of(directions.begin(), directions.end(), [&](double other) {
        return std::abs(std::remainder(here - other, 0.5 * geometry::kPi)) > kDirections.apart;
      });
      if (is_apart && sum > most) best = here;
      if (is_apart) most = std::max(most, sum);
    }
    if (!directions.empty() && most < kDirections.least_share * all) break;
    directions.push_back(meanAbout(facings, best));
  }
  return directions;
}

}  // namespace sightline::mapping
