#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "sightline/motion/pose_history.h"
#include "sightline/simulation/active_sensor.h"
#include "sightline/simulation/gait.h"
#include "sightline/simulation/path.h"
#include "sightline/simulation/robot.h"
#include "sightline/simulation/scanner.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// A sweep that has just ended.
struct FinishedSweep {
  std::size_t scanner = 0;  ///< in the order in which they were added
  scan::Scan scan;
};

/// A scan of an active sensor that has just ended.
struct FinishedRangeScan {
  std::size_t sensor = 0;  ///< in the order in which they were added
  motion::RangeScan range_scan;
};

/// A robot with its scanners in a world, in steps of a fixed length. Time is in nanoseconds from
/// the start of the run. The same configuration, seed and commands give the same run to the bit,
/// however often it is looked at.
class Simulation {
 public:
  static constexpr std::int64_t kStep = 5'000'000;  ///< [ns]

  /// Throws config::Error if the configuration is out of range.
  Simulation(world::World world, const RobotConfig& config, const geometry::Pose2& T_map_base,
             std::uint64_t seed);

  /// Sweeps begin at time 0. Throws config::Error.
  void addScanner(const ScannerProfile& profile, const Mounting& mounting);
  /// Samples begin at time 0, its head standing straight ahead. Throws config::Error.
  void addActiveSensor(const ActiveSensorProfile& profile, const Mounting& mounting);
  /// From now on a person carries the scanners: what the robot does is where that person goes, and
  /// the gait comes on top. Throws config::Error if the configuration is out of range.
  void walk(const GaitConfig& gait);
  /// From now on the path drives, and commands are not heard.
  void follow(const Path& path);
  /// What the robot shall do until the next command, or until the time-out.
  void command(const Velocity& velocity);
  /// What the head of an active sensor shall do; one that its limits do not allow is not heard.
  void commandHead(std::size_t sensor, const motion::HeadCommand& command);

  /// Moves on by kStep; the sweeps that ended within it, by scanner and time.
  std::vector<FinishedSweep> step();

  /// Those of active sensors that ended within the last step.
  const std::vector<FinishedRangeScan>& rangeScans() const { return range_scans_; }

  std::int64_t time() const { return time_; }
  const Robot& robot() const { return robot_; }
  /// As it was at the last sample, less than a sample ago.
  const motion::SensorHead& head(std::size_t sensor) const {
    return active_sensors_[sensor].sensor.head();
  }
  const triangulation::Calibration& calibration(std::size_t sensor) const {
    return active_sensors_[sensor].ranger.calibration();
  }
  /// Where the scanners' carrier is in the plane, gait and all; [0, time()] but no more than the
  /// last ten seconds.
  geometry::Pose2 T_map_base(std::int64_t time) const;
  /// How the trunk of a person moves at such a time; nothing moves on a robot.
  BodyMotion bodyMotion(std::int64_t time) const;

 private:
  struct Mounted {
    Scanner scanner;
    std::int64_t sweeps = 0;  ///< so far
    std::int64_t nextStamp() const;
  };
  struct MountedActiveSensor {
    ActiveSensor sensor;
    triangulation::Ranger ranger;
    Eigen::Isometry3d T_base_mount;
  };
  Velocity wanted();
  void walkOn();
  Eigen::Isometry3d carrierInSpace(std::int64_t time) const;
  scan::Scan sweep(Mounted& mounted) const;
  void advanceActiveSensors();

  world::World world_;
  RobotConfig config_;
  std::uint64_t seed_;
  Robot robot_;
  std::vector<Mounted> scanners_;
  std::vector<MountedActiveSensor> active_sensors_;
  std::vector<FinishedRangeScan> range_scans_;
  std::optional<PathFollower> follower_;
  std::int64_t departure_ = 0;  // of the follower
  Velocity command_;
  std::optional<std::int64_t> commanded_at_;
  std::int64_t time_ = 0;
  motion::PoseHistory way_;  // T_map_base without the gait
  GaitConfig gait_config_;
  std::optional<Gait> gait_;
  std::deque<BodyMotion> body_motions_;  // one a step; the last one is that of now
};

}  // namespace sightline::simulation
