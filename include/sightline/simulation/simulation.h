#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "sightline/motion/pose_history.h"
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
  /// From now on a person carries the scanners: what the robot does is where that person goes, and
  /// the gait comes on top. Throws config::Error if the configuration is out of range.
  void walk(const GaitConfig& gait);
  /// From now on the path drives, and commands are not heard.
  void follow(const Path& path);
  /// What the robot shall do until the next command, or until the time-out.
  void command(const Velocity& velocity);

  /// Moves on by kStep; the sweeps that ended within it, by scanner and time.
  std::vector<FinishedSweep> step();

  std::int64_t time() const { return time_; }
  const Robot& robot() const { return robot_; }
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
  Velocity wanted();
  void walkOn();
  scan::Scan sweep(Mounted& mounted) const;

  world::World world_;
  RobotConfig config_;
  std::uint64_t seed_;
  Robot robot_;
  std::vector<Mounted> scanners_;
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
