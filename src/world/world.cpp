#include "sightline/world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace sightline::world {

namespace {

Eigen::Vector3d homogeneous(const Eigen::Vector2d& point) {
  return {point.x(), point.y(), 1.0};
}

bool isWithin(const WorldPlate& plate, const Eigen::Vector2d& point) {
  for (std::size_t i = 0; i < plate.corners.size(); ++i) {
    const Eigen::Vector2d& from = plate.corners[i];
    const Eigen::Vector2d& to = plate.corners[(i + 1) % plate.corners.size()];
    const Eigen::Vector2d edge = to - from;
    const Eigen::Vector2d offset = point - from;
    if (edge.x() * offset.y() - edge.y() * offset.x() < 0.0) return false;
  }
  return true;
}

struct Interval {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

// Stretch of the ray within the (endless) round wall of a disc; empty if from >= to.
Interval withinRound(const WorldDisc& disc, const Ray& ray) {
  const Eigen::Vector2d across = ray.direction.head<2>();
  const Eigen::Vector2d offset = ray.origin.head<2>() - disc.centre;
  const double a = across.squaredNorm();
  const double b = across.dot(offset);
  const double c = offset.squaredNorm() - disc.radius * disc.radius;
  if (a == 0.0) return c < 0.0 ? Interval{} : Interval{0.0, 0.0};
  const double discriminant = b * b - a * c;
  if (discriminant <= 0.0) return {0.0, 0.0};
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

Interval withinHeights(double bottom, double top, const Ray& ray) {
  const double rise = ray.direction.z();
  const double below = bottom - ray.origin.z();
  const double above = top - ray.origin.z();
  if (rise == 0.0) return below <= 0.0 && above >= 0.0 ? Interval{} : Interval{0.0, 0.0};
  return {std::min(below / rise, above / rise), std::max(below / rise, above / rise)};
}

}  // namespace

World::World() : materials_{Material{}} {}

std::size_t World::addMaterial(const Material& material) {
  materials_.push_back(material);
  return materials_.size() - 1;
}

std::optional<std::size_t> World::findMaterial(const std::string& name) const {
  for (std::size_t i = materials_.size(); i-- > 0;) {
    if (materials_[i].name == name) return i;
  }
  return std::nullopt;
}

World::Side World::sideOf(const geometry::Segment& segment) {
  const Eigen::Vector3d start = homogeneous(segment.start);
  const Eigen::Vector3d end = homogeneous(segment.end);
  const Eigen::Vector3d line = start.cross(end);
  return {line / line.head<2>().norm(), start, end};
}

void World::add(const WorldSegment& segment) {
  sides_.push_back(sideOf(segment.segment));
  segments_.push_back(segment);
}

void World::replace(std::size_t index, const WorldSegment& segment) {
  sides_[index] = sideOf(segment.segment);
  segments_[index] = segment;
}

// The nearest one of the segments that are tried.
class World::NearestSegment {
 public:
  NearestSegment(const World& world, const Ray& ray)
      : world_(world),
        ray_(ray),
        origin_(homogeneous(ray.origin.head<2>())),
        infinity_(ray.direction.x(), ray.direction.y(), 0.0),
        line_(origin_.cross(infinity_)) {}

  void tryOne(std::size_t i) {
    const Side& side = world_.sides_[i];
    if (line_.dot(side.start) * line_.dot(side.end) > 0.0) return;
    const double candidate = -side.line.dot(origin_) / side.line.dot(infinity_);
    if (!(candidate > 0.0 && candidate < range_)) return;
    const double height = ray_.origin.z() + candidate * ray_.direction.z();
    if (height < world_.segments_[i].bottom || height > world_.segments_[i].top) return;
    range_ = candidate;
    hit_ = i;
  }
  std::optional<Hit> hit() const {
    if (!hit_) return std::nullopt;
    const double cosine = std::abs(world_.sides_[*hit_].line.dot(infinity_));
    return Hit{range_, world_.segments_[*hit_].material, cosine, hit_};
  }

 private:
  const World& world_;
  const Ray& ray_;
  Eigen::Vector3d origin_, infinity_, line_;
  double range_ = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> hit_;
};

std::optional<Hit> World::cast(const Ray& ray) const {
  NearestSegment segment(*this, ray);
  for (std::size_t i = 0; i < sides_.size(); ++i) segment.tryOne(i);
  auto nearest = segment.hit();
  castOthers(ray, nearest);
  return nearest;
}

std::optional<Hit> World::cast(const Ray& ray, const Shortlist& shortlist) const {
  NearestSegment segment(*this, ray);
  for (const std::size_t i : shortlist.segments) segment.tryOne(i);
  auto nearest = segment.hit();
  castOthers(ray, nearest);
  return nearest;
}

World::Shortlist World::shortlist(const Ray& axis, double half_width) const {
  const Eigen::Vector2d along = axis.direction.head<2>().normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d origin = axis.origin.head<2>();
  Shortlist result;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Eigen::Vector2d start = segments_[i].segment.start - origin;
    const Eigen::Vector2d end = segments_[i].segment.end - origin;
    const auto [right, left] = std::minmax({across.dot(start), across.dot(end)});
    const bool is_ahead = along.dot(start) > 0.0 || along.dot(end) > 0.0;
    if (is_ahead && right <= half_width && left >= -half_width) result.segments.push_back(i);
  }
  return result;
}

void World::castOthers(const Ray& ray, std::optional<Hit>& nearest) const {
  castDiscs(ray, nearest);
  if (ray.direction.z() != 0.0) castPlates(ray, nearest);
}

void World::castDiscs(const Ray& ray, std::optional<Hit>& nearest) const {
  for (const WorldDisc& disc : discs_) {
    const Interval round = withinRound(disc, ray);
    if (!(round.from < round.to)) continue;
    const Interval heights = withinHeights(disc.bottom, disc.top, ray);
    const double range = std::max(round.from, heights.from);
    if (!(range < std::min(round.to, heights.to)) || !(range > 0.0)) continue;
    if (nearest && range >= nearest->range) continue;
    const Eigen::Vector2d outward = (ray.origin + range * ray.direction).head<2>() - disc.centre;
    const double cos_incidence = round.from >= heights.from
                                     ? std::abs(outward.dot(ray.direction.head<2>())) / disc.radius
                                     : std::abs(ray.direction.z());
    nearest = Hit{range, disc.material, std::min(1.0, cos_incidence)};
  }
}

void World::castPlates(const Ray& ray, std::optional<Hit>& nearest) const {
  for (const WorldPlate& plate : plates_) {
    const double range = (plate.height - ray.origin.z()) / ray.direction.z();
    if (!(range > 0.0) || (nearest && range >= nearest->range)) continue;
    if (!isWithin(plate, (ray.origin + range * ray.direction).head<2>())) continue;
    nearest = Hit{range, plate.material, std::abs(ray.direction.z())};
  }
}

}  // namespace sightline::world
