#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "sightline/motion/pose_history.h"
#include "sightline/simulation/active_sensor.h"
#include "sightline/simulation/bumps.h"
#include "sightline/simulation/gait.h"
#include "sightline/simulation/outputs.h"
#include "sightline/simulation/path.h"
#include "sightline/simulation/robot.h"
#include "sightline/simulation/scanner.h"
#include "sightline/simulation/scene.h"
#include "sightline/simulation/turret.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::simulation {

/// A robot with its sensors, or a person who wears them. Moves in steps of kStep and then measures.
class Carrier {
 public:
  static constexpr std::int64_t kStep = 5'000'000;  ///< [ns]

  /// Throws config::Error if the configuration is out of range.
  Carrier(const RobotConfig& config, const geometry::Pose2& T_map_base, std::uint64_t seed);

  /// Sweeps begin at time 0. With a `turret_rate` [rad/s], counter-clockwise, it is on a turret
  /// that turns evenly, and stands straight ahead at time 0. Throws config::Error.
  void addScanner(const ScannerProfile& profile, const Mounting& mounting,
                  double turret_rate = 0.0);
  /// The same on a turret that is commanded, and stands straight ahead at first.
  void addScanner(const ScannerProfile& profile, const Mounting& mounting,
                  const motion::HeadLimits& turret);
  /// Samples begin at time 0, its head standing straight ahead. Throws config::Error.
  void addActiveSensor(const ActiveSensorProfile& profile, const Mounting& mounting);
  /// Makes a person carry the sensors from now on: the person goes where the robot would, and the
  /// gait comes on top. Throws config::Error if the configuration is out of range.
  void walk(const GaitConfig& gait);
  /// Follows a path from now on; commands are not heard.
  void follow(const Path& path);
  /// Commands the robot until the next command, or until the time-out.
  void command(const Velocity& velocity);
  /// Commands the head of an active sensor; a command that its limits do not allow is not heard.
  void commandHead(std::size_t sensor, const motion::HeadCommand& command);
  /// Commands the turret of a scanner that has one, alike.
  void commandTurret(std::size_t scanner, const motion::HeadCommand& command);
  /// Sets how often the odometry reports, 50 times a second by default.
  void setOdometryRate(double rate) { odometry_rate_ = rate; }

  /// Moves on by kStep.
  void move();
  /// Takes what the sensors measured up to now, in a world as this carrier sees it.
  void measure(const WorldAt& world_at, std::size_t index, Outputs& outputs);
  /// Report of the wheels now; their next mean velocity begins here.
  ReportedState report(std::size_t index);

  std::int64_t time() const { return time_; }
  const Robot& robot() const { return robot_; }
  /// Head as it was at the last sample, less than a sample ago.
  const motion::SensorHead& head(std::size_t sensor) const {
    return active_sensors_[sensor].sensor.head();
  }
  const triangulation::Calibration& calibration(std::size_t sensor) const {
    return active_sensors_[sensor].ranger.calibration();
  }
  /// Pose of a scanner at a time [ns], on its turret if it has one.
  Eigen::Isometry3d T_base_sensor(std::size_t scanner, std::int64_t time) const {
    return scanners_[scanner].scanner.T_base_sensor(time);
  }
  /// Pose of the carrier in the plane, gait and all; [0, time()] but no more than the last ten
  /// seconds.
  geometry::Pose2 T_map_base(std::int64_t time) const;
  /// Motion of a person's trunk at such a time, or the tilt of a robot on a bump.
  BodyMotion bodyMotion(std::int64_t time) const;

 private:
  struct Mounted {
    Scanner scanner;
    std::shared_ptr<Turret> turret;  // that is commanded; none otherwise
    std::int64_t sweeps = 0;         // so far
    std::int64_t nextStamp() const;
  };
  struct MountedActiveSensor {
    ActiveSensor sensor;
    triangulation::Ranger ranger;
    Eigen::Isometry3d T_base_mount;
  };
  Velocity wanted();
  void walkOn();
  void rollOn();
  void remember(const BodyMotion& motion);
  bool isReportDue() const;
  ReportedMotion inertialMotion(std::size_t index) const;
  Eigen::Isometry3d inMap(std::int64_t time) const;
  void turnTurrets(std::size_t index, Outputs& outputs);
  void sample(const WorldAt& world_at, std::size_t index, Outputs& outputs);
  void sweep(const WorldAt& world_at, std::size_t index, Outputs& outputs);

  RobotConfig config_;
  std::uint64_t seed_;
  Robot robot_;
  std::vector<Mounted> scanners_;
  std::vector<MountedActiveSensor> active_sensors_;
  std::optional<PathFollower> follower_;
  std::int64_t departure_ = 0;  // of the follower
  Velocity command_;
  std::optional<std::int64_t> commanded_at_;
  double odometry_rate_ = 50.0;  // [Hz]
  std::int64_t reports_ = 0;
  std::int64_t last_report_ = 0;  // [ns]
  std::int64_t time_ = 0;
  motion::PoseHistory path_;  // T_map_base without the gait
  GaitConfig gait_config_;
  std::optional<Gait> gait_;
  std::optional<Bumps> bumps_;           // of a robot on a floor that has some
  std::deque<BodyMotion> body_motions_;  // one a step; the last one is that of now
};

}  // namespace sightline::simulation
