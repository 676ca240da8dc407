#include "sightline/simulation/simulation.h"

#include <algorithm>
#include <cmath>

namespace sightline::simulation {

Simulation::Simulation(world::World world, const RobotConfig& config,
                       const geometry::Pose2& T_map_base, std::uint64_t seed)
    : world_(std::move(world)), config_(config), seed_(seed), robot_(config, T_map_base, seed) {
  config::validate(config);
  way_.add(time_, T_map_base);
}

void Simulation::addScanner(const ScannerProfile& profile, const Mounting& mounting) {
  // Each scanner gets noise of its own.
  const std::uint64_t seed = seed_ + (static_cast<std::uint64_t>(scanners_.size() + 1) << 32);
  scanners_.push_back({Scanner(profile, mounting, seed)});
}

void Simulation::addActiveSensor(const ActiveSensorProfile& profile, const Mounting& mounting) {
  const std::uint64_t seed = seed_ + (static_cast<std::uint64_t>(active_sensors_.size() + 1) << 48);
  active_sensors_.push_back({ActiveSensor(profile, seed),
                             triangulation::Ranger(profile.calibrated()),
                             mounting.T_base_sensor()});
}

void Simulation::walk(const GaitConfig& gait) {
  config::validate(gait);
  gait_config_ = gait;
  gait_.emplace(gait, seed_);
  body_motions_.assign(1, gait_->motion());
}

void Simulation::follow(const Path& path) {
  follower_.emplace(path, config_.acceleration);
  departure_ = time_ + std::llround(1e9 * path.wait);
}

void Simulation::command(const Velocity& velocity) {
  command_ = velocity;
  commanded_at_ = time_;
}

void Simulation::commandHead(std::size_t sensor, const motion::HeadCommand& command) {
  active_sensors_[sensor].sensor.command(command);
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

geometry::Pose2 Simulation::T_map_base(std::int64_t time) const {
  return *way_.at(time) * bodyMotion(time).inPlane();
}

BodyMotion Simulation::bodyMotion(std::int64_t time) const {
  if (!gait_) return {};
  const double ago = static_cast<double>(time_ - time) / static_cast<double>(kStep);
  const auto steps = static_cast<std::size_t>(ago);
  const std::size_t last = body_motions_.size() - 1;
  // Before the person was there, the trunk stood as it did first.
  if (steps >= last) return body_motions_.front();
  return interpolate(body_motions_[last - steps], body_motions_[last - steps - 1],
                     ago - static_cast<double>(steps));
}

void Simulation::walkOn() {
  constexpr std::size_t kRemembered = 10'000'000'000 / kStep;
  gait_->step(robot_.velocity().linear, 1e-9 * static_cast<double>(kStep));
  body_motions_.push_back(gait_->motion());
  if (body_motions_.size() > kRemembered) body_motions_.pop_front();
}

Eigen::Isometry3d Simulation::carrierInSpace(std::int64_t time) const {
  const Eigen::Isometry3d T_map_base = inSpace(this->T_map_base(time));
  return gait_ ? T_map_base * bodyMotion(time).outOfPlane(gait_config_.height) : T_map_base;
}

scan::Scan Simulation::sweep(Mounted& mounted) const {
  const std::int64_t stamp = mounted.nextStamp();
  ++mounted.sweeps;
  return mounted.scanner.sweepInSpace(world_, stamp,
                                      [this](std::int64_t time) { return carrierInSpace(time); });
}

void Simulation::advanceActiveSensors() {
  range_scans_.clear();
  for (std::size_t i = 0; i < active_sensors_.size(); ++i) {
    MountedActiveSensor& mounted = active_sensors_[i];
    const auto T_map_mount = [&](std::int64_t time) {
      return carrierInSpace(time) * mounted.T_base_mount;
    };
    for (const auto& raw : mounted.sensor.advance(world_, time_, T_map_mount)) {
      range_scans_.push_back({i, mounted.ranger.range(raw)});
    }
  }
}

std::vector<FinishedSweep> Simulation::step() {
  robot_.step(wanted(), 1e-9 * static_cast<double>(kStep));
  time_ += kStep;
  way_.add(time_, robot_.T_map_base());
  if (gait_) walkOn();
  advanceActiveSensors();
  std::vector<FinishedSweep> finished;
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    Mounted& mounted = scanners_[i];
    while (mounted.nextStamp() + mounted.scanner.sweepDuration() <= time_) {
      finished.push_back({i, sweep(mounted)});
    }
  }
  return finished;
}

}  // namespace sightline::simulation
