#include "sightline/simulation/optical_head.h"

#include <algorithm>
#include <cmath>

namespace sightline::simulation {

namespace {

constexpr double kTolerance = 1e-6;  // m

const Optics& validatedOptics(const Optics& optics) {
  config::validate(optics);
  return optics;
}

// Whether both points are on the same side of a wall's line: light does not pass through it.
bool onSameSide(const geometry::Segment& wall, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = wall.end - wall.start;
  const auto side = [&](const Eigen::Vector2d& p) {
    return along.x() * (p.y() - wall.start.y()) - along.y() * (p.x() - wall.start.x());
  };
  return side(a) * side(b) > 0.0;
}

Eigen::Vector3d inPlane(const Eigen::Vector2d& point) {
  return {point.x(), point.y(), 0.0};
}

// Offset in plan view [m].
double offsetFrom(const world::Ray& axis, const Eigen::Vector3d& point) {
  const Eigen::Vector2d along = axis.direction.head<2>().normalized();
  const Eigen::Vector2d displacement = (point - axis.origin).head<2>();
  return std::abs(along.x() * displacement.y() - along.y() * displacement.x());
}

}  // namespace

void Optics::visit(config::FieldVisitor& visitor) {
  visitor.integer("rays", rays, {"1", {1, 1000}, "across the laser beam (pears section 3.3)"});
  visitor.number("beam_width", beam_width,
                 {"m", {0.0, 0.1}, "between the points of 1/e^2 of the power density"});
  visitor.number("laser_power", laser_power, {"W", {1e-9, 100.0}, "pears table 1"});
  visitor.number("responsivity", responsivity, {"A/W", {1e-3, 100.0}, "of the detector"});
  visitor.number("lens_diameter", lens_diameter, {"m", {1e-4, 1.0}, "that gathers light"});
}

OpticalHead::OpticalHead(const triangulation::Intrinsics& intrinsics, const Optics& optics)
    : geometry_(intrinsics),
      rays_(raysOf(validatedOptics(optics))),
      full_current_(optics.laser_power * optics.responsivity * 0.25 * optics.lens_diameter *
                    optics.lens_diameter) {}

std::vector<OpticalHead::BeamRay> OpticalHead::raysOf(const Optics& optics) {
  std::vector<BeamRay> rays;
  double sum = 0.0;
  for (int i = 0; i < optics.rays; ++i) {
    const double place = (i + 0.5) / optics.rays - 0.5;                           // of the width
    rays.push_back({place * optics.beam_width, std::exp(-8.0 * place * place)});  // 1/e² at ±1/2
    sum += rays.back().share;
  }
  for (BeamRay& ray : rays) ray.share /= sum;
  return rays;
}

std::vector<OpticalHead::Spot> OpticalHead::illuminate(const world::World& world,
                                                       const Eigen::Isometry3d& T_map_projection,
                                                       double angle) const {
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d across(-along.y(), along.x());
  const auto lens = geometry_.lens(angle);
  const Eigen::Vector3d along_map = T_map_projection.linear() * inPlane(along);
  const Eigen::Vector3d across_map = T_map_projection.linear() * inPlane(across);
  const Eigen::Vector3d origin_map = T_map_projection.translation();
  const auto shortlist =
      world.shortlist({origin_map, along_map}, std::abs(rays_.front().offset) + kTolerance);
  std::vector<Spot> spots;
  spots.reserve(rays_.size());
  for (const BeamRay& ray : rays_) {
    const Eigen::Vector3d source_map = origin_map + ray.offset * across_map;
    const auto hit = world.cast({source_map, along_map}, shortlist);
    if (!hit) continue;
    const Eigen::Vector2d point = ray.offset * across + hit->range * along;
    if (lens.axis.dot(point - lens.centre) <= 0.0) continue;  // behind the lens
    const double p = geometry_.imagePosition(point, lens);
    if (std::abs(p) > 0.5 * geometry_.intrinsics().detector_length) continue;
    spots.push_back(
        {*hit, source_map, source_map + hit->range * along_map, full_current_ * ray.share, p});
  }
  return spots;
}

double OpticalHead::gatheredCurrent(const world::World& world, const Spot& spot,
                                    const Eigen::Vector3d& lens_map,
                                    const world::World::Shortlist& between) {
  if (spot.hit.segment && !onSameSide(world.segments()[*spot.hit.segment].segment,
                                      spot.source_map.head<2>(), lens_map.head<2>())) {
    return 0.0;
  }
  const Eigen::Vector3d displacement = spot.point_map - lens_map;
  const double distance = displacement.norm();
  const auto seen = world.cast({lens_map, displacement / distance}, between);
  if (!seen || std::abs(seen->range - distance) > kTolerance) return 0.0;
  return spot.full_current * world.materials()[spot.hit.material].reflectivity *
         seen->cos_incidence / (distance * distance);
}

SpotImage OpticalHead::look(const world::World& world, const Eigen::Isometry3d& T_map_projection,
                            double angle) const {
  SpotImage image;
  const auto spots = illuminate(world, T_map_projection, angle);
  if (spots.empty()) return image;
  const Eigen::Vector3d lens_map = T_map_projection * inPlane(geometry_.lens(angle).centre);
  const world::Ray axis{lens_map, (spots.front().point_map - lens_map).normalized()};
  double half_width = kTolerance;
  for (const Spot& spot : spots) {
    half_width = std::max(half_width, kTolerance + offsetFrom(axis, spot.point_map));
  }
  const auto between = world.shortlist(axis, half_width);
  for (const Spot& spot : spots) {
    const double current = gatheredCurrent(world, spot, lens_map, between);
    image.current += current;
    image.image_position += current * spot.image_position;
  }
  if (image.current > 0.0) image.image_position /= image.current;
  return image;
}

}  // namespace sightline::simulation
