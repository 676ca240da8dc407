#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "building.h"
#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/geometry/angle.h"
#include "sightline/logs/nees.h"
#include "sightline/simulation/simulation.h"

/// Pose at the end of a long way, and how far its covariance is to be believed: a robot on wheels,
/// 181 beams over 180° at 5 Hz that reach 8 m, by the scans alone.
///
/// odometry.corridor_60m.along_over_sigma: root mean square, over corridors of 60 m with recesses,
/// of the error along the corridor over its standard deviation; along_m: of the error itself.
/// odometry.tour_500m.nees: of the pose (3 degrees of freedom), mean of whole tours through rooms
/// and corridors.
namespace sightline::bench {

class LongWay {
 public:
  LongWay(Building building, std::uint64_t seed)
      : building_(std::move(building)),
        start_(startOf(building_)),
        simulation_(building_.world, {}, start_, seed),
        reckoner_({}) {
    simulation::ScannerProfile scanner;
    scanner.beams = 181;
    scanner.angle_min = -0.5 * geometry::kPi;
    scanner.angle_max = 0.5 * geometry::kPi;
    scanner.range_max = 8.0;
    scanner.rate = 5.0;
    scanner.revolution = 0.0;
    scanner.resolution = 0.01;
    scanner.noise.sigma = 0.01;
    simulation::Mounting mounting;
    mounting.z = 0.3;
    simulation_.carrier().addScanner(scanner, mounting);
    simulation::Path path;
    path.speed = 0.8;
    path.waypoints_map = building_.way;
    simulation_.carrier().follow(path);
  }

  void run() {
    while (!hasArrived()) {
      for (const auto& sweep : simulation_.step().sweeps) take(sweep.scan);
    }
  }

  double meanNees() const { return nees_ / scans_; }
  double errorAlong() const { return error_.x(); }
  double sigmaAlong() const { return std::sqrt(pose_.covariance(0, 0)); }

 private:
  using Pose2 = geometry::Pose2;

  static Pose2 startOf(const Building& building) {
    const Eigen::Vector2d ahead = building.way[1] - building.way[0];
    return {building.way[0], std::atan2(ahead.y(), ahead.x())};
  }

  bool hasArrived() const {
    const Eigen::Vector2d here = simulation_.robot().T_map_base().translation();
    return (here - building_.way.back()).norm() < 0.5;
  }

  // The frame odom begins where the first scan was taken.
  void take(const scan::Scan& scan) {
    const Pose2 truth = simulation_.carrier().T_map_base(scan.stamp);
    const auto update = reckoner_.update(scan, Pose2());
    if (!update) return;
    if (scans_ == 0.0) start_ = truth;
    const Pose2 truth_odom = geometry::between(start_, truth);
    pose_ = update->pose;
    error_ = pose_.mean.coordinates() - truth_odom.coordinates();
    if (scans_ > 0.0) nees_ += logs::nees(pose_, truth_odom);
    scans_ += 1.0;
  }

  Building building_;
  Pose2 start_;
  simulation::Simulation simulation_;
  dead_reckoning::DeadReckoner reckoner_;
  geometry::UncertainPose2 pose_;
  Eigen::Vector3d error_ = Eigen::Vector3d::Zero();
  double nees_ = 0.0;
  double scans_ = 0.0;
};

inline void measureCorridors() {
  constexpr std::uint64_t kSeeds = 10;
  double ratio = 0.0;
  double error = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    LongWay way(recessedCorridor(60.0, 8.0, seed), seed);
    way.run();
    ratio += std::pow(way.errorAlong() / way.sigmaAlong(), 2) / kSeeds;
    error += std::pow(way.errorAlong(), 2) / kSeeds;
  }
  fmt::print("odometry.corridor_60m.along_over_sigma {:.2f} 1\n", std::sqrt(ratio));
  fmt::print("odometry.corridor_60m.along_m {:.3f} m\n", std::sqrt(error));
}

inline void measureTours() {
  constexpr std::uint64_t kSeeds = 3;
  double nees = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    LongWay way(serpentineBuilding(500.0, seed), seed);
    way.run();
    nees += way.meanNees() / kSeeds;
  }
  fmt::print("odometry.tour_500m.nees {:.2f} 1\n", nees);
}

inline void measureLongWays() {
  measureCorridors();
  measureTours();
}

}  // namespace sightline::bench
