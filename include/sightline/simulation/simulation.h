#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sightline/simulation/carrier.h"
#include "sightline/simulation/mover.h"
#include "sightline/simulation/outputs.h"
#include "sightline/simulation/scene.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// Robots with their sensors, and what else moves, in one world and by one clock, in steps of a
/// fixed length. Robots and movers are seen by the sensors of the others, and drive through each
/// other. Time is in nanoseconds from the start of the run. The same configuration, seed and
/// commands give the same run to the bit, however often it is looked at; what is random about a
/// robot does not depend on how many there are.
class Simulation {
 public:
  static constexpr std::int64_t kStep = Carrier::kStep;  ///< [ns]

  Simulation(world::World world, std::uint64_t seed) : scene_(std::move(world)), seed_(seed) {}
  /// Simulates a world with a first robot.
  Simulation(world::World world, const RobotConfig& config, const geometry::Pose2& T_map_base,
             std::uint64_t seed);

  /// Robots count from 0. To be added before the first step. Throws config::Error if the
  /// configuration is out of range.
  Carrier& addRobot(const RobotConfig& config, const geometry::Pose2& T_map_base);
  /// Adds something that follows a path and is seen as `body`. To be added before the first step.
  /// Throws config::Error.
  void addMover(const Body& body, const Path& path, const geometry::Pose2& T_map_start);

  /// Moves on by kStep and returns what was measured meanwhile. The first step also reports the
  /// states of time 0.
  Outputs step();

  std::int64_t time() const { return time_; }
  std::size_t robots() const { return carriers_.size(); }
  Carrier& carrier(std::size_t robot = 0) { return *carriers_[robot]; }
  const Carrier& carrier(std::size_t robot = 0) const { return *carriers_[robot]; }
  const Robot& robot(std::size_t robot = 0) const { return carriers_[robot]->robot(); }

 private:
  Scene scene_;
  std::uint64_t seed_;
  // Kept at fixed places, as the scene asks them where they are.
  std::vector<std::unique_ptr<Carrier>> carriers_;
  std::vector<std::unique_ptr<Mover>> movers_;
  std::vector<std::size_t> bodies_;  // of each robot, in the scene
  std::int64_t time_ = 0;
};

}  // namespace sightline::simulation
