#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "sightline/config/fields.h"
#include "sightline/scan/scan.h"
#include "sightline/simulation/mounting.h"
#include "sightline/simulation/random_stream.h"
#include "sightline/simulation/scanner_profile.h"
#include "sightline/simulation/scene.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// A scanner that takes its beams one after the other while its carrier moves, and while the turret
/// turns that it may be mounted on.
class Scanner {
 public:
  /// The carrier's pose at a time [ns].
  using PoseAt = std::function<geometry::Pose2(std::int64_t)>;
  /// Pose of a carrier which leans and bobs; its origin at the floor while it stands upright.
  using PoseInSpaceAt = std::function<Eigen::Isometry3d(std::int64_t)>;

  /// How far a turret has turned from the mounting at a time [ns]: [rad], counter-clockwise about
  /// the mounting's z axis.
  using TurretAngle = std::function<double(std::int64_t)>;

  /// Fixed, until it is put on a turret. Throws config::Error if the profile does not fit together.
  Scanner(const ScannerProfile& profile, const Mounting& mounting, std::uint64_t seed);
  void mountOn(TurretAngle turret) { turret_ = std::move(turret); }

  const ScannerProfile& profile() const { return profile_; }
  std::int64_t sweepDuration() const { return sweep_duration_; }  ///< [ns]
  Eigen::Isometry3d T_base_sensor(std::int64_t time) const;

  /// The sweep whose first beam leaves at `stamp` [ns], in the sensor's own frame, with the
  /// variances of the profile's noise. The motion of the sensor is left for the estimators to find.
  scan::Scan sweep(const world::World& world, std::int64_t stamp, const PoseAt& T_map_base);
  scan::Scan sweepInSpace(const world::World& world, std::int64_t stamp,
                          const PoseInSpaceAt& T_map_base);
  /// The same in a world in which things move.
  scan::Scan sweepInSpace(const WorldAt& world_at, std::int64_t stamp,
                          const PoseInSpaceAt& T_map_base);

 private:
  struct Echo {
    double range;      // [m]
    double intensity;  // 0 where nothing was measured
  };
  Echo measureBeam(const world::World& world, const Eigen::Isometry3d& T_map_sensor,
                   std::size_t beam);
  std::optional<world::Hit> look(const world::World& world, const Eigen::Isometry3d& T_map_sensor,
                                 double angle) const;
  std::optional<world::Hit> lookNoisily(const world::World& world,
                                        const Eigen::Isometry3d& T_map_sensor, double angle);
  double intensityOf(const world::Hit& hit, const world::Material& material) const;
  double noisyRange(double range, double intensity);
  double uniform(double half_width);

  ScannerProfile profile_;
  Eigen::Isometry3d T_base_turret_;
  TurretAngle turret_;  // none: fixed
  std::shared_ptr<const scan::ScanGeometry> geometry_;
  std::int64_t sweep_duration_;
  RandomStream random_;
  std::normal_distribution<double> normal_;
};

}  // namespace sightline::simulation
