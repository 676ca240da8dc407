#include "sightline/simulation/optical_head.h"

#include <cmath>

namespace sightline::simulation {

namespace {

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

}  // namespace

void Optics::visit(config::FieldVisitor& visitor) {
  visitor.integer("rays", rays, {"1", {1, 1000}, "across the laser beam (pears section 3.3)"});
  visitor.number("beam_width", beam_width,
                 {"m", {0.0, 0.1}, "between the points of 1/e^2 of the power density"});
  visitor.number("laser_power", laser_power, {"W", config::kPositive, "pears table 1"});
  visitor.number("responsivity", responsivity, {"A/W", config::kPositive, "of the detector"});
  visitor.number("lens_diameter", lens_diameter, {"m", config::kPositive, "that gathers light"});
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

double OpticalHead::gatheredShare(const world::World& world, const world::Hit& hit,
                                  const Eigen::Vector3d& source_map,
                                  const Eigen::Vector3d& spot_map,
                                  const Eigen::Vector3d& lens_map) const {
  constexpr double kTolerance = 1e-6;  // m
  if (hit.segment && !onSameSide(world.segments()[*hit.segment].segment, source_map.head<2>(),
                                 lens_map.head<2>())) {
    return 0.0;
  }
  const Eigen::Vector3d way = spot_map - lens_map;
  const double distance = way.norm();
  const auto seen = world.cast({lens_map, way / distance});
  if (!seen || std::abs(seen->range - distance) > kTolerance) return 0.0;
  return world.materials()[hit.material].reflectivity * seen->cos_incidence / (distance * distance);
}

SpotImage OpticalHead::look(const world::World& world, const Eigen::Isometry3d& T_map_projection,
                            double angle) const {
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d across(-along.y(), along.x());
  const auto inMap = [&](const Eigen::Vector2d& p) -> Eigen::Vector3d {
    return T_map_projection * Eigen::Vector3d(p.x(), p.y(), 0.0);
  };
  const Eigen::Vector3d along_map =
      T_map_projection.linear() * Eigen::Vector3d(along.x(), along.y(), 0.0);
  const Eigen::Vector3d lens_map = inMap(geometry_.lensCentre(angle));
  SpotImage image;
  for (const BeamRay& ray : rays_) {
    const Eigen::Vector2d source = ray.offset * across;
    const Eigen::Vector3d source_map = inMap(source);
    const auto hit = world.cast({source_map, along_map});
    if (!hit) continue;
    const double p = geometry_.imagePosition(Eigen::Vector2d(source + hit->range * along), angle);
    if (std::abs(p) > 0.5 * geometry_.intrinsics().detector_length) continue;
    const Eigen::Vector3d spot_map = source_map + hit->range * along_map;
    const double current =
        full_current_ * ray.share * gatheredShare(world, *hit, source_map, spot_map, lens_map);
    image.current += current;
    image.image_position += current * p;
  }
  if (image.current > 0.0) image.image_position /= image.current;
  return image;
}

}  // namespace sightline::simulation
