#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "sightline/geometry/isometry.h"
#include "sightline/simulation/simulation.h"
#include "sightline/targets/action_set.h"
#include "sightline/targets/bearing_detector.h"
#include "sightline/targets/line_of_sight.h"
#include "sightline/targets/target_log.h"

namespace sightline::bench {

/// What one robot saw of the hallway at one time, by a scanner of 0.25° and by one of 1°.
struct HallwayLook {
  std::size_t robot = 0;
  std::int64_t stamp = 0;
  geometry::Pose2 T_map_sensor;  // true
  double turn_rate = 0.0;
  std::vector<double> fine;
  std::vector<double> coarse;
  std::vector<Eigen::Vector2d> mates_map;
  double brightest_clutter = 0.0;                     // intensity
  std::vector<std::pair<double, double>> brightness;  // range and intensity of each target in sight
};

struct HallwayConfig {
  std::uint64_t seed = 1;
  double minutes = 20.0;
  double rate = 2.0;  // looks a second
  int people = 2;
  std::string world = "hallway_targets.yaml";  // what is seen; ways are those of the hallway
  simulation::BumpConfig bumps{0.21, 0.3, 0.008, 0.2};
};

/// Three robots that choose random ways through the shipped hallway, among people (dames section
/// 2).
class HallwayRun {
 public:
  explicit HallwayRun(const HallwayConfig& config)
      : config_(config),
        targets_map_(targets::readTargetTruth(path("config/worlds/hallway_targets.csv"))),
        sight_(std::make_shared<targets::WorldSight>(
            world::World::readFile(path("config/worlds/hallway.yaml")), kHeight)),
        actions_(targets::ActionSetConfig{}, sight_),
        simulation_(world::World::readFile(path("config/worlds/" + config.world)), config.seed),
        random_(config.seed) {
    const geometry::Pose2 starts[] = {{-8.0, 0.0, 0.0}, {6.0, 0.0, 0.0}, {0.0, 8.0, 1.57}};
    for (const geometry::Pose2& start : starts) addRobot(start);
    for (int i = 0; i < config.people; ++i) addPerson(i);
  }

  const logs::Points& targets() const { return targets_map_; }
  bool isInSight(const HallwayLook& look, const Eigen::Vector2d& target) const {
    return sight_->isClear(look.T_map_sensor.translation(), target);
  }

  std::vector<HallwayLook> run() {
    std::vector<HallwayLook> looks;
    const auto end = static_cast<std::int64_t>(60e9 * config_.minutes);
    while (simulation_.time() < end) {
      if (simulation_.time() % 100'000'000 == 0) steer();
      const auto outputs = simulation_.step();
      for (const auto& sweep : outputs.sweeps) take(sweep, looks);
    }
    return looks;
  }

 private:
  static constexpr double kHeight = 0.4;
  static constexpr double kBack = 5.0;  // time for a way back [s]
  static std::string path(const std::string& name) {
    return std::string(SIGHTLINE_SOURCE_DIR) + "/" + name;
  }

  void addRobot(const geometry::Pose2& start) {
    simulation::RobotConfig robot;
    robot.max_speed = 0.6;
    robot.bumps = config_.bumps;
    simulation::Carrier& carrier = simulation_.addRobot(robot, start);
    auto profile = simulation::ScannerProfile::readFile(path("config/sensors/utm30lx.yaml"));
    profile.rate = config_.rate;
    simulation::Mounting mounting;
    mounting.z = kHeight;
    carrier.addScanner(profile, mounting);
    profile.beams = 271;
    carrier.addScanner(profile, mounting);
    goals_.push_back(start.translation());
    starts_.push_back(start.translation());
    deadlines_.push_back(0);
    detectors_.emplace_back();
  }

  void addPerson(int index) {
    simulation::Body body;
    body.radius = 0.2;
    body.top = 1.75;
    simulation::Path loop;
    loop.speed = 1.2;
    loop.repeat = true;
    const double side = index % 2 == 0 ? 16.8 : -16.8;
    loop.waypoints_map = {{side, 0.3}, {side, 16.0}, {0.0, 16.2}, {0.0, 0.2}};
    simulation_.addMover(body, loop, {0.0, 0.2, 0.0});
  }

  geometry::Pose2 T_map_sensor(std::size_t robot, std::int64_t time) const {
    return simulation_.carrier(robot).T_map_base(time);
  }

  // A robot that has come to the end of its way, or stands, takes another one.
  void steer() {
    for (std::size_t i = 0; i < simulation_.robots(); ++i) {
      const geometry::Pose2 pose = simulation_.robot(i).T_map_base();
      // Nothing stops a simulated robot at a wall: one that has turned through it goes back.
      if (!sight_->isClear(starts_[i], pose.translation())) {
        send(i, starts_[i], kBack);
        continue;
      }
      const bool has_arrived = (goals_[i] - pose.translation()).norm() < 0.15;
      if (!has_arrived && simulation_.time() < deadlines_[i]) continue;
      const auto actions = actions_.from(pose);
      if (actions.empty()) continue;
      std::uniform_int_distribution<std::size_t> any(0, actions.size() - 1);
      const targets::SearchAction& action = actions[any(random_)];
      starts_[i] = pose.translation();
      send(i, action.poses.back().translation(), action.duration);
    }
  }

  void send(std::size_t robot, const Eigen::Vector2d& goal, double duration) {
    if (goals_[robot] == goal && simulation_.time() < deadlines_[robot]) return;
    goals_[robot] = goal;
    deadlines_[robot] = simulation_.time() + std::llround(2e9 * (duration + 5.0));
    simulation::Path way;
    way.speed = 0.5;
    way.tolerance = 0.1;
    way.turn_rate = 1.5;
    way.waypoints_map = {goal};
    simulation_.carrier(robot).follow(way);
  }

  // As odometry tells it on a robot.
  void addMotion(std::size_t robot, scan::Scan& scan) const {
    std::vector<geometry::Pose2> motion;
    const geometry::Pose2 first = T_map_sensor(robot, scan.stamp);
    for (const double offset : scan.geometry()->timeOffsets()) {
      motion.push_back(
          geometry::between(first, T_map_sensor(robot, scan.stamp + std::llround(1e9 * offset))));
    }
    scan.setSensorMotion(std::move(motion));
  }

  void take(simulation::FinishedSweep sweep, std::vector<HallwayLook>& looks) {
    addMotion(sweep.robot, sweep.scan);
    const auto set = detectors_[sweep.robot].detect(sweep.scan);
    if (sweep.scanner == 1) {
      looks.back().coarse = set.bearings;
      return;
    }
    HallwayLook look;
    look.robot = sweep.robot;
    look.stamp = sweep.scan.stamp;
    look.T_map_sensor = T_map_sensor(sweep.robot, sweep.scan.stamp);
    look.turn_rate = simulation_.robot(sweep.robot).velocity().angular;
    look.fine = set.bearings;
    for (std::size_t i = 0; i < simulation_.robots(); ++i) {
      if (i != sweep.robot) {
        look.mates_map.push_back(T_map_sensor(i, sweep.scan.stamp).translation());
      }
    }
    addBrightness(sweep.scan, look);
    looks.push_back(std::move(look));
  }

  void addBrightness(const scan::Scan& scan, HallwayLook& look) const {
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      if (!scan.isValid(beam) || scan.intensities()[beam] < 5000.0) continue;
      const Eigen::Vector2d point = look.T_map_sensor * scan.point(beam);
      const bool is_target =
          std::any_of(targets_map_.begin(), targets_map_.end(),
                      [&](const Eigen::Vector2d& target) { return (target - point).norm() < 0.1; });
      const double intensity = scan.intensities()[beam];
      if (is_target) {
        look.brightness.emplace_back(scan.ranges()[beam], intensity);
      } else {
        look.brightest_clutter = std::max(look.brightest_clutter, intensity);
      }
    }
  }

  HallwayConfig config_;
  logs::Points targets_map_;
  std::shared_ptr<const targets::WorldSight> sight_;
  targets::ActionSet actions_;
  simulation::Simulation simulation_;
  std::vector<targets::BearingDetector> detectors_;
  std::vector<Eigen::Vector2d> goals_;
  std::vector<Eigen::Vector2d> starts_;  // of the present ways
  std::vector<std::int64_t> deadlines_;  // at which another way is taken all the same
  std::mt19937_64 random_;
};

}  // namespace sightline::bench
