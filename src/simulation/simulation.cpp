#include "sightline/simulation/simulation.h"

#include <utility>

namespace sightline::simulation {

namespace {

// The first robot has the seed of the run itself; those of the others lie far from each other.
std::uint64_t seedOfRobot(std::uint64_t seed, std::size_t robot) {
  return seed + static_cast<std::uint64_t>(robot) * 0x9e3779b97f4a7c15U;
}

}  // namespace

Simulation::Simulation(world::World world, const RobotConfig& config,
                       const geometry::Pose2& T_map_base, std::uint64_t seed)
    : Simulation(std::move(world), seed) {
  addRobot(config, T_map_base);
}

Carrier& Simulation::addRobot(const RobotConfig& config, const geometry::Pose2& T_map_base) {
  carriers_.push_back(
      std::make_unique<Carrier>(config, T_map_base, seedOfRobot(seed_, carriers_.size())));
  Carrier* const carrier = carriers_.back().get();
  bodies_.push_back(
      scene_.add(config.body, [carrier](std::int64_t time) { return carrier->T_map_base(time); }));
  return *carrier;
}

void Simulation::addMover(const Body& body, const Path& path, const geometry::Pose2& T_map_start) {
  movers_.push_back(std::make_unique<Mover>(path, T_map_start));
  const Mover* const mover = movers_.back().get();
  scene_.add(body, [mover](std::int64_t time) { return mover->T_map_body(time); });
}

Outputs Simulation::step() {
  Outputs outputs;
  for (std::size_t i = 0; time_ == 0 && i < carriers_.size(); ++i) {
    outputs.states.push_back(carriers_[i]->report(i));
  }
  time_ += kStep;
  // All move before anyone looks, so that everyone is seen where he was at the time of a beam.
  for (const auto& carrier : carriers_) carrier->move();
  for (const auto& mover : movers_) mover->moveTo(time_);
  for (std::size_t i = 0; i < carriers_.size(); ++i) {
    const auto world_at = [this, body = bodies_[i]](std::int64_t time) -> const world::World& {
      return scene_.at(time, body);
    };
    carriers_[i]->measure(world_at, i, outputs);
  }
  return outputs;
}

}  // namespace sightline::simulation
