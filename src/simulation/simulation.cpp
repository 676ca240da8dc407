#include "sightline/simulation/simulation.h"

#include <algorithm>
#include <cmath>

namespace sightline::simulation {

Simulation::Simulation(world::World world, const RobotConfig& config,
                       const geometry::Pose2& T_map_base, std::uint64_t seed)
    : world_(std::move(world)), config_(config), seed_(seed), robot_(config, T_map_base, seed) {
  config::validate(config);
  T_map_base_.add(time_, T_map_base);
}

void Simulation::addScanner(const ScannerProfile& profile, const Mounting& mounting) {
  // Each scanner gets noise of its own.
  const std::uint64_t seed = seed_ + (static_cast<std::uint64_t>(scanners_.size() + 1) << 32);
  scanners_.push_back({Scanner(profile, mounting, seed)});
}

void Simulation::follow(const Path& path) {
  follower_.emplace(path, config_.acceleration);
  departure_ = time_ + std::llround(1e9 * path.wait);
}

void Simulation::command(const Velocity& velocity) {
  command_ = velocity;
  commanded_at_ = time_;
}

Velocity Simulation::wanted() {
  if (follower_) return time_ < departure_ ? Velocity{} : follower_->steer(robot_.T_map_base());
  const bool is_fresh =
      commanded_at_ && static_cast<double>(time_ - *commanded_at_) < config_.command_timeout * 1e9;
  return is_fresh ? command_ : Velocity{};
}

std::int64_t Simulation::Mounted::nextStamp() const {
  return std::llround(1e9 * static_cast<double>(sweeps) / scanner.profile().rate);
}

std::vector<FinishedSweep> Simulation::step() {
  robot_.step(wanted(), 1e-9 * static_cast<double>(kStep));
  time_ += kStep;
  T_map_base_.add(time_, robot_.T_map_base());
  std::vector<FinishedSweep> finished;
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    Mounted& mounted = scanners_[i];
    while (mounted.nextStamp() + mounted.scanner.sweepDuration() <= time_) {
      const auto T_map_base = [&](std::int64_t time) { return *T_map_base_.at(time); };
      finished.push_back({i, mounted.scanner.sweep(world_, mounted.nextStamp(), T_map_base)});
      ++mounted.sweeps;
    }
  }
  return finished;
}

}  // namespace sightline::simulation
