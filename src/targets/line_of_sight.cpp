#include "sightline/targets/line_of_sight.h"

namespace sightline::targets {

bool WorldSight::isClear(const Eigen::Vector2d& from_map, const Eigen::Vector2d& to_map) const {
  const Eigen::Vector2d way = to_map - from_map;
  const double distance = way.norm();
  if (distance <= tolerance_) return true;
  world::Ray ray;
  ray.origin << from_map, height_;
  ray.direction << way / distance, 0.0;
  const auto hit = world_.cast(ray);
  return !hit || hit->range >= distance - tolerance_;
}

std::shared_ptr<const LineOfSight> worldSight(const std::string& path, double height) {
  if (path.empty()) return nullptr;
  return std::make_shared<WorldSight>(world::World::readFile(path), height);
}

bool GridSight::isClear(const Eigen::Vector2d& from_map, const Eigen::Vector2d& to_map) const {
  const double distance = (to_map - from_map).norm() - tolerance_;
  if (distance <= 0.0) return true;
  const Eigen::Vector2d from = T_grid_map_ * from_map;
  const Eigen::Vector2d direction = (T_grid_map_ * to_map - from).normalized();
  // Half a cell misses a corner at most.
  for (double way = 0.0; way < distance; way += 0.5 * grid_.resolution) {
    if (grid_.at(from + way * direction) == world::Occupancy::kOccupied) return false;
  }
  return true;
}

}  // namespace sightline::targets
