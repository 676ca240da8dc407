#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/LU>

#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/logs/nees.h"
#include "sightline/simulation/simulation.h"

/// How far the covariances are to be believed, in simulation: a robot on wheels, 361 beams and 181
/// beams over 180° at 5 Hz, 8 m and 80 m of reach, through the furnished rooms and the corridor of
/// config/worlds/floor.yaml.
///
/// odometry.nees: of the steps from scan to scan (3 degrees of freedom), all runs together;
/// odometry.nees_corridor: of those within its plain part.
namespace sightline::bench {

struct Consistency {
  double nees = 0.0;
  double corridor = 0.0;
  double steps = 0.0;
  double corridor_steps = 0.0;
};

class ConsistencyRun {
 public:
  ConsistencyRun(int beams, double reach, std::uint64_t seed)
      : simulation_(world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/floor.yaml"), {},
                    kStart, seed),
        reckoner_({}) {
    simulation::ScannerProfile scanner;
    scanner.beams = beams;
    scanner.angle_min = -0.5 * geometry::kPi;
    scanner.angle_max = 0.5 * geometry::kPi;
    scanner.range_max = reach;
    scanner.rate = 5.0;
    scanner.revolution = 0.0;
    scanner.resolution = 0.01;
    scanner.noise.sigma = 0.01;
    simulation::Mounting mounting;
    mounting.z = 0.3;
    simulation_.carrier().addScanner(scanner, mounting);
    auto path = simulation::Path::readFile(SIGHTLINE_SOURCE_DIR "/config/paths/floor_tour.yaml");
    path.wait = 0.0;
    simulation_.carrier().follow(path);
  }

  void run(Consistency& sum) {
    constexpr std::int64_t kEnd = 50'000'000'000;  // ns: it has arrived
    while (simulation_.time() < kEnd) {
      for (const auto& sweep : simulation_.step().sweeps) score(sweep.scan, sum);
    }
  }

 private:
  using Pose2 = geometry::Pose2;
  static inline const Pose2 kStart{-2.2, 4.6, 0.0};

  void score(const scan::Scan& scan, Consistency& sum) {
    const Pose2 truth = simulation_.carrier().T_map_base(scan.stamp);
    const auto update = reckoner_.update(scan, Pose2());
    if (update && update->state != dead_reckoning::MatchState::kInitial) {
      const double nees = logs::nees(update->step, geometry::between(before_, truth));
      sum.nees += nees;
      sum.steps += 1.0;
      // Between its doors.
      if (truth.x() > 2.0 && truth.x() < 9.0 && truth.y() > -1.0 && truth.y() < 1.0) {
        sum.corridor += nees;
        sum.corridor_steps += 1.0;
      }
    }
    before_ = truth;
  }

  simulation::Simulation simulation_;
  dead_reckoning::DeadReckoner reckoner_;
  Pose2 before_;
};

inline void measureConsistency() {
  constexpr std::uint64_t kSeeds = 5;
  Consistency sum;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const int beams : {181, 361}) {
      for (const double reach : {8.0, 80.0}) ConsistencyRun(beams, reach, seed).run(sum);
    }
  }
  fmt::print("odometry.nees {:.2f} 1\n", sum.nees / sum.steps);
  fmt::print("odometry.nees_corridor {:.2f} 1\n", sum.corridor / sum.corridor_steps);
}

}  // namespace sightline::bench
