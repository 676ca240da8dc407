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

// Where along the ray it is within the (endless) round wall of a disc; empty if from >= to.
Interval withinRound(const WorldDisc& disc, const Ray& ray) {
  const Eigen::Vector2d way = ray.direction.head<2>();
  const Eigen::Vector2d offset = ray.origin.head<2>() - disc.centre;
  const double a = way.squaredNorm();
  const double b = way.dot(offset);
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

void World::add(const WorldSegment& segment) {
  const Eigen::Vector3d start = homogeneous(segment.segment.start);
  const Eigen::Vector3d end = homogeneous(segment.segment.end);
  const Eigen::Vector3d line = start.cross(end);
  sides_.push_back({line / line.head<2>().norm(), start, end});
  segments_.push_back(segment);
}

std::optional<Hit> World::cast(const Ray& ray) const {
  std::optional<Hit> nearest;
  castSegments(ray, nearest);
  castDiscs(ray, nearest);
  if (ray.direction.z() != 0.0) castPlates(ray, nearest);
  return nearest;
}

void World::castSegments(const Ray& ray, std::optional<Hit>& nearest) const {
  const Eigen::Vector3d origin = homogeneous(ray.origin.head<2>());
  const Eigen::Vector3d infinity(ray.direction.x(), ray.direction.y(), 0.0);
  const Eigen::Vector3d line = origin.cross(infinity);
  double range = std::numeric_limits<double>::infinity();
  std::size_t hit = sides_.size();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    if (line.dot(side.start) * line.dot(side.end) > 0.0) continue;
    const double candidate = -side.line.dot(origin) / side.line.dot(infinity);
    if (!(candidate > 0.0 && candidate < range)) continue;
    const double height = ray.origin.z() + candidate * ray.direction.z();
    if (height < segments_[i].bottom || height > segments_[i].top) continue;
    range = candidate;
    hit = i;
  }
  if (hit == sides_.size()) return;
  nearest = Hit{range, segments_[hit].material, std::abs(sides_[hit].line.dot(infinity)), hit};
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
