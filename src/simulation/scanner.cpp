#include "sightline/simulation/scanner.h"

#include <cmath>
#include <limits>

#include "sightline/geometry/isometry.h"

namespace sightline::simulation {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const ScannerProfile& checked(const ScannerProfile& profile) {
  profile.check("");
  return profile;
}

double rounded(double value, double step) {
  return step > 0.0 ? step * std::round(value / step) : value;
}

}  // namespace

Scanner::Scanner(const ScannerProfile& profile, const Mounting& mounting, std::uint64_t seed)
    : profile_(checked(profile)),
      T_base_turret_(mounting.T_base_sensor()),
      geometry_(profile.geometry()),
      sweep_duration_(std::llround(profile.sweepDuration() * 1e9)),
      random_(randomStream(seed, 1)) {}

Eigen::Isometry3d Scanner::T_base_sensor(std::int64_t time) const {
  if (!turret_) return T_base_turret_;
  return T_base_turret_ * Eigen::AngleAxisd(turret_(time), Eigen::Vector3d::UnitZ());
}

scan::Scan Scanner::sweep(const world::World& world, std::int64_t stamp, const PoseAt& T_map_base) {
  return sweepInSpace(world, stamp,
                      [&](std::int64_t time) { return geometry::inSpace(T_map_base(time)); });
}

scan::Scan Scanner::sweepInSpace(const world::World& world, std::int64_t stamp,
                                 const PoseInSpaceAt& T_map_base) {
  return sweepInSpace(still(world), stamp, T_map_base);
}

scan::Scan Scanner::sweepInSpace(const WorldAt& world_at, std::int64_t stamp,
                                 const PoseInSpaceAt& T_map_base) {
  std::vector<double> ranges;
  std::vector<double> intensities;
  ranges.reserve(geometry_->beams());
  for (std::size_t beam = 0; beam < geometry_->beams(); ++beam) {
    const std::int64_t time = stamp + std::llround(geometry_->timeOffsets()[beam] * 1e9);
    const Echo echo = measureBeam(world_at(time), T_map_base(time) * T_base_sensor(time), beam);
    ranges.push_back(echo.range);
    if (profile_.intensity > 0.0) intensities.push_back(echo.intensity);
  }
  scan::Scan scan(geometry_, stamp, std::move(ranges), std::move(intensities));
  scan::applyNoise(profile_.noise, scan);
  return scan;
}

Scanner::Echo Scanner::measureBeam(const world::World& world, const Eigen::Isometry3d& T_map_sensor,
                                   std::size_t beam) {
  const auto hit = lookNoisily(world, T_map_sensor, geometry_->angles()[beam]);
  const double intensity = hit ? intensityOf(*hit, world.materials()[hit->material]) : 0.0;
  double range = hit ? noisyRange(hit->range, intensity) : kInfinity;
  if (hit && hit->range < profile_.range_min) range = -kInfinity;
  if (profile_.dropout > 0.0 && 0.5 + uniform(0.5) < profile_.dropout) {
    range = std::numeric_limits<double>::quiet_NaN();
  }
  const bool is_valid = scan::classify(range, *geometry_) == scan::ReturnKind::kValid;
  return {range, is_valid ? intensity : 0.0};
}

std::optional<world::Hit> Scanner::look(const world::World& world,
                                        const Eigen::Isometry3d& T_map_sensor, double angle) const {
  const Eigen::Vector3d direction_sensor(std::cos(angle), std::sin(angle), 0.0);
  return world.cast({T_map_sensor.translation(), T_map_sensor.linear() * direction_sensor});
}

// The beam really leaves in a direction that is a little off the one it is reported for.
std::optional<world::Hit> Scanner::lookNoisily(const world::World& world,
                                               const Eigen::Isometry3d& T_map_sensor,
                                               double angle) {
  const scan::NoiseModel& noise = profile_.noise;
  if (noise.kind == scan::NoiseKind::kUniform) {
    return look(world, T_map_sensor, angle + uniform(noise.angle_half_width));
  }
  double sigma = noise.angular_sigma;
  if (noise.kind == scan::NoiseKind::kIsotropic) {
    const auto hit = look(world, T_map_sensor, angle);
    if (!hit) return hit;
    sigma = std::hypot(sigma, noise.sigma / hit->range);
  }
  return look(world, T_map_sensor, angle + sigma * normal_(random_));
}

// What the material returns, and an optical gain that is held near to the sensor.
double Scanner::intensityOf(const world::Hit& hit, const world::Material& material) const {
  const double ratio = hit.range / profile_.intensity_half_range;
  return profile_.intensity * material.returned(hit.cos_incidence) / (1.0 + ratio * ratio);
}

double Scanner::noisyRange(double range, double intensity) {
  const scan::NoiseModel& noise = profile_.noise;
  // The uniform error of a quantising scanner comes from rounding.
  if (noise.kind == scan::NoiseKind::kUniform) return rounded(range, 2.0 * noise.range_half_width);
  const double sigma = std::sqrt(noise.rangeVariance(range, intensity));
  return rounded(range + sigma * normal_(random_), profile_.resolution);
}

double Scanner::uniform(double half_width) {
  return std::uniform_real_distribution<double>(-half_width, half_width)(random_);
}

}  // namespace sightline::simulation
