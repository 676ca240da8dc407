#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>

#include <Eigen/Geometry>

#include "sightline/config/fields.h"
#include "sightline/scan/scan.h"
#include "sightline/simulation/random_stream.h"
#include "sightline/simulation/scanner_profile.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// Where a sensor sits on its robot; angles as roll, pitch and yaw about the robot's fixed axes,
/// so that a roll of π mounts it upside down.
struct Mounting {
  double x = 0.0;      ///< [m], forward
  double y = 0.0;      ///< [m], left
  double z = 0.0;      ///< [m] above the floor
  double roll = 0.0;   ///< [rad]
  double pitch = 0.0;  ///< [rad], positive looks down
  double yaw = 0.0;    ///< [rad]

  void visit(config::FieldVisitor& visitor);
  Eigen::Isometry3d T_base_sensor() const;
};

/// A pose of the plane as one in space, upright on the floor.
Eigen::Isometry3d inSpace(const geometry::Pose2& pose);

/// A scanner that takes its beams one after the other while its carrier moves.
class Scanner {
 public:
  /// The carrier's pose at a time [ns].
  using PoseAt = std::function<geometry::Pose2(std::int64_t)>;
  /// That of a carrier which leans and bobs; its origin at the floor while it stands upright.
  using PoseInSpaceAt = std::function<Eigen::Isometry3d(std::int64_t)>;

  /// Throws config::Error if the profile does not fit together.
  Scanner(const ScannerProfile& profile, const Mounting& mounting, std::uint64_t seed);

  const ScannerProfile& profile() const { return profile_; }
  std::int64_t sweepDuration() const { return sweep_duration_; }  ///< [ns]

  /// The sweep whose first beam leaves at `stamp` [ns], in the sensor's own frame, with the
  /// variances of the profile's noise. The motion of the sensor is left for the estimators to find.
  scan::Scan sweep(const world::World& world, std::int64_t stamp, const PoseAt& T_map_base);
  scan::Scan sweepInSpace(const world::World& world, std::int64_t stamp,
                          const PoseInSpaceAt& T_map_base);

 private:
  struct Echo {
    double range;      // [m]
    double intensity;  // 0 where nothing was measured
  };
  Echo measureBeam(const world::World& world, const Eigen::Isometry3d& T_map_base,
                   std::size_t beam);
  std::optional<world::Hit> look(const world::World& world, const Eigen::Isometry3d& T_map_sensor,
                                 double angle) const;
  std::optional<world::Hit> lookNoisily(const world::World& world,
                                        const Eigen::Isometry3d& T_map_sensor, double angle);
  double intensityOf(const world::Hit& hit, const world::Material& material) const;
  double noisyRange(double range, double intensity);
  double uniform(double half_width);

  ScannerProfile profile_;
  Eigen::Isometry3d T_base_sensor_;
  std::shared_ptr<const scan::ScanGeometry> geometry_;
  std::int64_t sweep_duration_;
  RandomStream random_;
  std::normal_distribution<double> normal_;
};

}  // namespace sightline::simulation
