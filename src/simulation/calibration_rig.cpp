#include "sightline/simulation/calibration_rig.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "sightline/simulation/random_stream.h"
#include "sightline/triangulation/flat_target.h"
#include "sightline/triangulation/photocurrents.h"

namespace sightline::simulation {

namespace {

using triangulation::BeamAverage;
using triangulation::TargetPlacement;

class Rig {
 public:
  Rig(const triangulation::SensorParameters& sensor, const Optics& optics, const RigConfig& config,
      std::uint64_t seed)
      : sensor_(sensor),
        optics_(optics),
        config_(config),
        head_(sensor.intrinsics, optics),
        random_(randomStream(seed, 0)) {
    T_sensor_projection_.translation().head<2>() = sensor.origin.position();
  }

  TargetPlacement plain(double depth);
  TargetPlacement striped(double depth);

 private:
  void look(const world::World& world, TargetPlacement& target);
  bool isWhole(const SpotImage& spot, double depth, double angle) const;
  BeamAverage average(const SpotImage& spot, std::size_t beam);
  double halfWidth(double depth) const;

  triangulation::SensorParameters sensor_;
  Optics optics_;
  RigConfig config_;
  OpticalHead head_;
  RandomStream random_;
  std::normal_distribution<double> normal_;
  Eigen::Isometry3d T_sensor_projection_ = Eigen::Isometry3d::Identity();
};

// Largest y [m] of the field of view, and a little farther.
double Rig::halfWidth(double depth) const {
  const double angle =
      0.5 * sensor_.scan.field_of_view + std::abs(sensor_.origin.projected_vergence);
  return 0.1 + std::abs(sensor_.origin.y) + depth * std::tan(angle);
}

world::WorldSegment upright(double depth, double from, double to, std::size_t material) {
  world::WorldSegment wall;
  wall.segment = {{depth, from}, {depth, to}};
  wall.bottom = -1.0;
  wall.top = 1.0;
  wall.material = material;
  return wall;
}

TargetPlacement Rig::plain(double depth) {
  world::World world;
  const auto bright = world.addMaterial({"bright", config_.reflectivity});
  world.add(upright(depth, -halfWidth(depth), halfWidth(depth), bright));
  TargetPlacement target;
  target.depth = depth;
  look(world, target);
  return target;
}

TargetPlacement Rig::striped(double depth) {
  world::World world;
  const auto bright = world.addMaterial({"bright", config_.reflectivity});
  const auto dark = world.addMaterial({"dark", config_.dark_reflectivity});
  TargetPlacement target;
  target.depth = depth;
  target.stripes = triangulation::Stripes{config_.stripe_edge, config_.stripe_width};
  const int count = static_cast<int>(std::ceil(halfWidth(depth) / config_.stripe_width)) + 1;
  for (int i = -count; i < count; ++i) {
    world.add(upright(depth, target.stripes->edgeAt(i), target.stripes->edgeAt(i + 1),
                      i % 2 == 0 ? bright : dark));
  }
  look(world, target);
  return target;
}

void Rig::look(const world::World& world, TargetPlacement& target) {
  for (int beam = 0; beam < sensor_.scan.beams; ++beam) {
    const double angle = sensor_.scan.scanAngle(beam) + sensor_.origin.projected_vergence;
    const SpotImage spot = head_.look(world, T_sensor_projection_, angle);
    if (!isWhole(spot, target.depth - sensor_.origin.x, angle)) continue;
    target.beams.push_back(average(spot, static_cast<std::size_t>(beam)));
  }
}

bool Rig::isWhole(const SpotImage& spot, double depth, double angle) const {
  if (spot.current < sensor_.scan.min_current) return false;
  const auto shape =
      triangulation::spotOnTarget(head_.geometry(), depth, angle, optics_.beam_width);
  return std::abs(spot.image_position) + 1.1 * shape.half_length <
         0.5 * sensor_.intrinsics.detector_length;
}

BeamAverage Rig::average(const SpotImage& spot, std::size_t beam) {
  const double share = 1.0 / std::sqrt(config_.readings);
  const double sigma = triangulation::imagePositionSigma(spot.current, sensor_.noise_current,
                                                         sensor_.intrinsics.detector_length);
  BeamAverage average;
  average.beam = beam;
  average.readings = config_.readings;
  average.image_position = spot.image_position + share * sigma * normal_(random_);
  average.current = spot.current + share * sensor_.noise_current * normal_(random_);
  return average;
}

}  // namespace

void RigConfig::visit(config::FieldVisitor& visitor) {
  const config::Range reflectivities{1e-3, 1.0};
  visitor.number("nearest", nearest, {"m", {1e-3, 100.0}, "depth of the nearest plain target"});
  visitor.number("farthest", farthest, {"m", {1e-3, 1000.0}, "depth of the farthest"});
  visitor.integer("depths", depths, {"1", {2, 1000}, "of plain targets, uniform in 1/depth"});
  visitor.integer("readings", readings, {"1", {1, 1000000}, "averaged, of each target"});
  visitor.number("reflectivity", reflectivity,
                 {"1", reflectivities, "of plain targets and bright stripes"});
  visitor.number("stripe_width", stripe_width, {"m", {1e-3, 10.0}, "dark and bright alike"});
  visitor.number("stripe_edge", stripe_edge,
                 {"m", {-10.0, 10.0}, "of an edge with a bright stripe to its left"});
  visitor.number("dark_reflectivity", dark_reflectivity,
                 {"1", reflectivities, "of every other stripe"});
  visitor.numbers("striped_depths", striped_depths,
                  {"m", {1e-3, 1000.0}, "depths of the striped target"});
}

void RigConfig::check(const std::string& source) const {
  config::validate(*this, source);
  const auto fail = [&](const char* key, const char* reason) {
    throw config::Error(source, 0, key, reason);
  };
  if (nearest >= farthest) fail("nearest", "is not below farthest");
  if (dark_reflectivity >= reflectivity) fail("dark_reflectivity", "is not below reflectivity");
}

triangulation::CalibrationRecording recordCalibration(const triangulation::SensorParameters& sensor,
                                                      const Optics& optics, const RigConfig& config,
                                                      std::uint64_t seed) {
  sensor.check("");
  config.check("");
  Rig rig(sensor, optics, config, seed);
  triangulation::CalibrationRecording recording;
  const auto depths = triangulation::tableDepths(config.nearest, config.farthest,
                                                 static_cast<std::size_t>(config.depths));
  const auto keep = [&](TargetPlacement target) {
    if (!target.beams.empty()) recording.placements.push_back(std::move(target));
  };
  for (const double depth : depths) keep(rig.plain(depth));
  for (const double depth : config.striped_depths) keep(rig.striped(depth));
  return recording;
}

}  // namespace sightline::simulation
