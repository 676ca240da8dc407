#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/LU>

#include "building.h"
#include "sightline/config/node.h"
#include "sightline/geometry/isometry.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/simulation/simulation.h"

/// Figures of a scanner that a walking person carries, with no odometry and no attitude known:
/// 200 m through rooms and corridors, 361 beams over 180° at 5 Hz.
///
/// odometry.body_worn.drift_percent, heading_deg: error at the end of the way over its length, mean
/// of the walks, and mean error of the heading there. bad_steps: steps from scan to scan that are
/// off by more than 0.2 m or 5°, all walks together. odometry.body_worn_<method>.*: by the thesis's
/// own methods, searched in its worst-case window of ±0.4 m and ±40° at 5 Hz. floor_recall,
/// floor_precision: of the beams that ended on floor or ceiling. odometry.body_worn.corridor_*: 20
/// m along a corridor without any feature: NEES of the steps (3 degrees of freedom) and share of
/// them that are flagged.
namespace sightline::bench {

struct BodyWornScore {
  int walks = 0;
  int scans = 0;
  double drift = 0.0;    // share of the way, summed over walks
  double heading = 0.0;  // rad, summed over walks
  int steps = 0;
  int bad_steps = 0;
  int bad_flagged = 0;
  int good_flagged = 0;
  double nees = 0.0;  // summed over steps
  long floor_found = 0;
  long floor_missed = 0;
  long floor_mistaken = 0;
};

/// A scan of a walk, with the truth.
struct BodyWornView {
  scan::Scan scan;
  geometry::Pose2 T_map_base;
  std::vector<bool> on_floor;  // by beam; ceiling counts, too
};

/// One walk with its score.
class BodyWornWalk {
 public:
  BodyWornWalk(const Building& building, double reach, std::uint64_t seed,
               dead_reckoning::Method method = dead_reckoning::Method::kSubmap)
      : building_(building),
        simulation_(building.world, person(), start(), seed),
        odometry_(profileOfCarrier(method), floorOfCarrier()) {
    simulation_.carrier().walk({});
    simulation::ScannerProfile scanner;
    scanner.beams = 361;
    scanner.angle_min = geometry::radians(-90.0);
    scanner.angle_max = geometry::radians(90.0);
    scanner.range_max = reach;
    scanner.rate = 5.0;
    scanner.revolution = 0.0266;
    scanner.resolution = 0.01;
    scanner.noise.sigma = 0.01;
    simulation::Mounting mounting;
    mounting.z = kHeight;
    simulation_.carrier().addScanner(scanner, mounting);
    simulation::Path path;
    path.speed = simulation::GaitConfig().speed;
    path.turn_rate = geometry::radians(200.0);
    path.waypoints_map = building.way;
    simulation_.carrier().follow(path);
  }

  void run(BodyWornScore& score) {
    while (!hasArrived()) {
      for (const auto& sweep : simulation_.step().sweeps) take(sweep.scan, score);
      way_ += simulation_.robot().velocity().linear * 1e-9 * simulation::Simulation::kStep;
    }
    const geometry::Pose2 error = geometry::between(truth_, estimate_);
    ++score.walks;
    score.drift += error.translation().norm() / way_;
    score.heading += std::abs(error.theta());
  }

  /// The scans of the whole way.
  std::vector<BodyWornView> look() {
    std::vector<BodyWornView> views;
    while (!hasArrived()) {
      for (auto& sweep : simulation_.step().sweeps) {
        BodyWornView view{std::move(sweep.scan), {}, {}};
        view.T_map_base = simulation_.carrier().T_map_base(view.scan.stamp);
        for (std::size_t i = 0; i < view.scan.beams(); ++i) {
          view.on_floor.push_back(view.scan.isValid(i) && endsOnFloor(view.scan, i));
        }
        views.push_back(std::move(view));
      }
    }
    return views;
  }

 private:
  using Pose2 = geometry::Pose2;
  static constexpr double kHeight = 1.2;  // of the scanner, m

  static simulation::RobotConfig person() {
    simulation::RobotConfig person;
    person.max_speed = 1.5;
    person.max_turn_rate = geometry::radians(200.0);
    person.acceleration = 1.5;
    person.turn_acceleration = 25.0;
    return person;
  }

  static config::Node carrier() {
    return config::Node::readFile(SIGHTLINE_SOURCE_DIR "/config/carriers/body_worn.yaml");
  }
  static pipeline::ScanOdometryConfig profileOfCarrier(dead_reckoning::Method method) {
    pipeline::ScanOdometryConfig config;
    config::read(carrier().at("odometry"), config);
    config.matching.method = method;
    // A velocity that may be any other at the next scan: the window is what the bounds allow.
    if (method != dead_reckoning::Method::kSubmap) {
      config.matching.carrier = {2.0, geometry::radians(200.0), 100.0, 100.0};
    }
    return config;
  }
  static motion::FloorConfig floorOfCarrier() {
    motion::FloorConfig config;
    config::read(carrier().at("floor"), config);
    return config;
  }

  Pose2 start() const {
    const Eigen::Vector2d ahead = building_.way[1] - building_.way[0];
    return {building_.way[0], std::atan2(ahead.y(), ahead.x())};
  }

  bool hasArrived() const {
    const Eigen::Vector2d here = simulation_.robot().T_map_base().translation();
    return (here - building_.way.back()).norm() < 0.5;
  }

  static pipeline::LocatedScan located(const scan::Scan& scan) {
    pipeline::LocatedScan located;
    located.scan = scan;
    return located;
  }

  void take(const scan::Scan& scan, BodyWornScore& score) {
    const Pose2 truth = simulation_.carrier().T_map_base(scan.stamp);
    const auto update = odometry_.update(located(scan));
    ++score.scans;
    countFloor(scan, score);
    if (score.scans > 1 && begun_) scoreStep(geometry::between(before_, truth), *update, score);
    if (!begun_) T_map_odom_ = truth;
    begun_ = true;
    before_ = truth;
    truth_ = truth;
    estimate_ = T_map_odom_ * update->pose.mean;
  }

  static void scoreStep(const Pose2& truth, const dead_reckoning::DeadReckoningUpdate& update,
                        BodyWornScore& score) {
    Eigen::Vector3d error = update.step.mean.coordinates() - truth.coordinates();
    error[2] = geometry::wrapAngle(error[2]);
    const bool is_bad = error.head<2>().norm() > 0.2 || std::abs(error[2]) > geometry::radians(5.0);
    ++score.steps;
    score.nees += error.dot(update.step.covariance.inverse() * error);
    score.bad_steps += is_bad;
    score.bad_flagged += is_bad && update.isFlagged();
    score.good_flagged += !is_bad && update.isFlagged();
  }

  bool endsOnFloor(const scan::Scan& scan, std::size_t beam) const {
    const auto time = scan.stamp + std::llround(1e9 * scan.geometry()->timeOffsets()[beam]);
    const Eigen::Isometry3d T_map_sensor =
        geometry::inSpace(simulation_.carrier().T_map_base(time)) *
        simulation_.carrier().bodyMotion(time).outOfPlane(kHeight) *
        Eigen::Translation3d(0.0, 0.0, kHeight);
    const Eigen::Vector3d direction(scan.geometry()->cosines()[beam],
                                    scan.geometry()->sines()[beam], 0.0);
    const auto hit =
        building_.world.cast({T_map_sensor.translation(), T_map_sensor.linear() * direction});
    return hit && !hit->segment;
  }

  void countFloor(const scan::Scan& scan, BodyWornScore& score) const {
    const std::vector<bool>& found = odometry_.beamsOnFloor();
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      if (!scan.isValid(i)) continue;
      const bool is_floor = endsOnFloor(scan, i);
      score.floor_found += is_floor && found[i];
      score.floor_missed += is_floor && !found[i];
      score.floor_mistaken += !is_floor && found[i];
    }
  }

  const Building& building_;
  simulation::Simulation simulation_;
  pipeline::ScanOdometry odometry_;
  bool begun_ = false;
  Pose2 T_map_odom_;
  Pose2 before_;
  Pose2 truth_;
  Pose2 estimate_;
  double way_ = 0.0;
};

inline double percent(double part, double whole) {
  return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

inline void measureBuildings(int seeds) {
  BodyWornScore score;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Building building = serpentineBuilding(200.0, static_cast<std::uint64_t>(seed));
    BodyWornWalk(building, 80.0, static_cast<std::uint64_t>(seed)).run(score);
  }
  const char* name = "odometry.body_worn";
  const auto found = static_cast<double>(score.floor_found);
  fmt::print("{}.drift_percent {:.3f} %\n", name, 100.0 * score.drift / score.walks);
  fmt::print("{}.heading_deg {:.3f} deg\n", name, geometry::degrees(score.heading / score.walks));
  fmt::print("{}.bad_steps {} 1\n", name, score.bad_steps);
  fmt::print("{}.bad_steps_flagged {} 1\n", name, score.bad_flagged);
  fmt::print("{}.good_steps_flagged {:.2f} %\n", name, percent(score.good_flagged, score.steps));
  fmt::print("{}.nees {:.2f} 1\n", name, score.nees / score.steps);
  fmt::print("{}.floor_recall {:.1f} %\n", name,
             percent(found, found + static_cast<double>(score.floor_missed)));
  fmt::print("{}.floor_precision {:.1f} %\n", name,
             percent(found, found + static_cast<double>(score.floor_mistaken)));
}

inline void measureMethodsOnWalks(int seeds) {
  using dead_reckoning::Method;
  for (const auto& [method, name] :
       {std::pair(Method::kHistogram, "histogram"), {Method::kPoseSpace, "pose_space"}}) {
    BodyWornScore score;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Building building = serpentineBuilding(200.0, static_cast<std::uint64_t>(seed));
      BodyWornWalk(building, 80.0, static_cast<std::uint64_t>(seed), method).run(score);
    }
    fmt::print("odometry.body_worn_{}.drift_percent {:.3f} %\n", name,
               100.0 * score.drift / score.walks);
    fmt::print("odometry.body_worn_{}.bad_steps {} 1\n", name, score.bad_steps);
    fmt::print("odometry.body_worn_{}.nees {:.2f} 1\n", name, score.nees / score.steps);
  }
}

inline void measurePlainCorridor(int seeds) {
  constexpr double kReach = 8.0;  // m: neither end of the corridor is ever seen
  const Building corridor = plainCorridor(20.0, kReach);
  BodyWornScore score;
  for (int seed = 1; seed <= seeds; ++seed) {
    BodyWornWalk(corridor, kReach, static_cast<std::uint64_t>(seed)).run(score);
  }
  fmt::print("odometry.body_worn.corridor_nees {:.2f} 1\n", score.nees / score.steps);
  fmt::print("odometry.body_worn.corridor_flagged {:.1f} %\n",
             percent(score.bad_flagged + score.good_flagged, score.steps));
}

inline void measureBodyWorn() {
  constexpr int kSeeds = 20;
  measureBuildings(kSeeds);
  measurePlainCorridor(kSeeds);
  constexpr int kSlowSeeds = 3;
  measureMethodsOnWalks(kSlowSeeds);
}

}  // namespace sightline::bench
