#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "scripted_transforms.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/isometry.h"
#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/scan_feed.h"
#include "sightline/scan/noise_model.h"
#include "sightline/simulation/simulation.h"
#include "sightline/tracking/room_tracker.h"

/// Two rooms of 8x6 and 5x6 m joined by a door of 0.9 m, driven through in 120 s, under the
/// tracker.
namespace sightline::test {

using geometry::Pose2;

constexpr double kTwoRoomsSeconds = 120.0;

inline const char* const kTwoRooms = R"(
rooms:
  east: {size: [5.0, 6.0], pose: [6.6, 0.0, 0.0]}
  west: {size: [8.0, 6.0], pose: [0.0, 0.0, 0.0]}
doors:
  - {between: [west, east], at: [4.05, 0.5], width: 0.9}
)";

inline const char* const kTwoRoomsPath = R"(
speed: 0.4
turn_rate: 0.8
tolerance: 0.2
waypoints: [[-2, -2], [2, -2], [2, 0.5], [6, 0.5], [8, 2], [8, -2], [6, -2], [5, 0.5], [2, 0.5], [2, 2], [-3, 2],
            [-3, -2], [2, -2], [2, 0.5], [6, 0.5], [8, 2], [8, -2], [6, -2], [5, 0.5], [2, 0.5], [-3, 2]]
)";

struct TwoRoomsScenario {
  std::string name;
  double clutter = 0.0;          // share of the beams that something nearer stops
  double unreported_turn = 0.0;  // of the robot at half time [rad]
  bool utm30lx = false;          // 1081 beams over 270° at 40 Hz instead
  bool full_circle = false;      // 361 beams over 360° in 0.1 s, of a scanner on a turret
  double turret_rate = 0.0;      // [rad/s]
};

struct PoseSample {
  double position_error = 0.0;  // m
  double heading_error = 0.0;   // rad
  double nees = 0.0;            // of x, y and heading
  double microseconds = 0.0;
};

inline world::RoomMap twoRooms() {
  return world::RoomMap(config::Node::parse(kTwoRooms, "two rooms"));
}

inline simulation::ScannerProfile scannerProfile(const TwoRoomsScenario& scenario) {
  simulation::ScannerProfile profile;
  if (scenario.utm30lx) return profile;
  profile.beams = 361;
  profile.angle_min = -0.5 * geometry::kPi;
  profile.angle_max = 0.5 * geometry::kPi;
  profile.range_max = 8.0;
  profile.rate = 10.0;
  profile.noise.sigma = 0.01;
  if (scenario.full_circle) {
    profile.angle_min = -geometry::kPi;
    profile.angle_max = geometry::radians(179.0);
    profile.revolution = 0.1;
  }
  return profile;
}

inline simulation::RobotConfig robotConfig() {
  simulation::RobotConfig config;
  config.odometry.scale_mean = 1.02;
  config.odometry.scale_sigma = 0.0;
  config.odometry.heading_bias_per_metre = 0.0;
  config.odometry.steering_bias = 0.0;
  config.odometry.steering_sigma = 0.01;
  return config;
}

/// Believes that the map is exact, as it is, and knows the errors of the wheels but for the scale.
inline tracking::TrackerConfig trackerConfig() {
  tracking::TrackerConfig config;
  config.odometry = robotConfig().odometry;
  config.odometry.scale_mean = 1.0;
  config.odometry.scale_sigma = 0.02;
  config.wall.position_sigma = 0.0;
  config.wall.direction_sigma = 0.0;
  return config;
}

inline void addClutter(double share, std::mt19937_64& random, scan::Scan& scan) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (unit(random) >= share) continue;
    const double reach = scan.isValid(i) ? scan.ranges()[i] : scan.geometry()->rangeMax();
    scan.setRange(i, 0.3 + (reach - 0.3) * unit(random));
  }
}

class TwoRoomsDrive {
 public:
  /// The feed believes the noise of the scanner and of the wheels that it is told.
  TwoRoomsDrive(const TwoRoomsScenario& scenario, std::uint64_t seed,
                const tracking::TrackerConfig& config, scan::NoiseKind noise)
      : scenario_(scenario),
        random_(seed),
        simulation_(world::World::of(twoRooms()), robotConfig(), start_, seed),
        feed_(feedConfig(config, noise), {}, {}, transforms_),
        tracker_(config, twoRooms()) {
    feed_.addScanner();
    simulation_.carrier().addScanner(scannerProfile(scenario), {}, scenario.turret_rate);
    moveTurret();
    simulation_.carrier().follow(simulation::Path(config::Node::parse(kTwoRoomsPath, "path")));
    tracker_.setPose({start_, Eigen::Vector3d(0.01, 0.01, 0.0025).asDiagonal()});
  }

  std::vector<PoseSample> samples() {
    while (simulation_.time() < static_cast<std::int64_t>(kTwoRoomsSeconds * 1e9)) {
      auto finished = simulation_.step().sweeps;
      moveTurret();
      truth_.add(simulation_.time(), simulation_.robot().T_map_base());
      reportOdometry();
      for (auto& sweep : finished) take(sweep.scan);
      track();
    }
    return samples_;
  }

 private:
  // At 50 Hz, as wheels do.
  void reportOdometry() {
    if (simulation_.time() % 20'000'000 != 0) return;
    transforms_.drive(simulation_.time(), slip() * simulation_.robot().odometry().pose().mean);
  }

  void moveTurret() {
    const std::int64_t time = simulation_.time();
    const auto T_base_sensor = simulation_.carrier().T_base_sensor(0, time);
    transforms_.turret("", time, geometry::inPlane(T_base_sensor));
  }

  // The wheels miss a turn on the spot: from then on the odometry is turned the other way about the
  // robot.
  Pose2 slip() {
    if (scenario_.unreported_turn == 0.0 ||
        simulation_.time() < static_cast<std::int64_t>(5e8 * kTwoRoomsSeconds))
      return {};
    if (!slipped_) {
      const Pose2 here = simulation_.robot().odometry().pose().mean;
      T_slip_ = here * Pose2(0.0, 0.0, -scenario_.unreported_turn) * here.inverse();
      slipped_ = true;
    }
    return T_slip_;
  }

  static pipeline::FeedConfig feedConfig(const tracking::TrackerConfig& config,
                                         scan::NoiseKind noise) {
    pipeline::FeedConfig feed;
    feed.noise.kind = noise;
    feed.sweep_noise = config.odometry;
    return feed;
  }

  void take(scan::Scan& scan) {
    addClutter(scenario_.clutter, random_, scan);
    feed_.add(0, std::move(scan), simulation_.time());
  }

  void track() {
    const auto begin = std::chrono::steady_clock::now();
    while (const auto result = feed_.next(simulation_.time())) {
      const auto& located = result->located;
      if (!located || !located->T_odom_base) continue;
      const auto update =
          tracker_.update(located->scan, *located->T_odom_base, *located->T_base_sensor);
      const std::chrono::duration<double, std::micro> spent =
          std::chrono::steady_clock::now() - begin;
      if (update) score(*update, *truth_.at(result->stamp), spent.count());
    }
  }

  void score(const tracking::TrackerUpdate& update, const Pose2& truth, double microseconds) {
    Eigen::Vector3d error = update.pose.mean.coordinates() - truth.coordinates();
    error[2] = geometry::wrapAngle(error[2]);
    samples_.push_back({error.head<2>().norm(), std::abs(error[2]),
                        error.dot(update.pose.covariance.inverse() * error), microseconds});
  }

  TwoRoomsScenario scenario_;
  Pose2 start_{-2.0, 1.0, -1.5};
  std::mt19937_64 random_;
  simulation::Simulation simulation_;
  test::ScriptedTransforms transforms_;
  pipeline::ScanFeed feed_;
  tracking::RoomTracker tracker_;
  motion::PoseHistory truth_;
  bool slipped_ = false;
  Pose2 T_slip_;
  std::vector<PoseSample> samples_;
};

}  // namespace sightline::test
