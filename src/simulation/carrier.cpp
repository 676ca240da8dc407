#include "sightline/simulation/carrier.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/isometry.h"

namespace sightline::simulation {

namespace {

const RobotConfig& checkedConfig(const RobotConfig& config) {
  config::validate(config);
  return config;
}

}  // namespace

Carrier::Carrier(const RobotConfig& config, const geometry::Pose2& T_map_base, std::uint64_t seed)
    : config_(checkedConfig(config)), seed_(seed), robot_(config, T_map_base, seed) {
  path_.add(time_, T_map_base);
  if (config_.bumps.share == 0.0) return;
  bumps_.emplace(config_.bumps, seed);
  remember({0.0, 0.0, 0.0, {0.0, bumps_->pitch()}});
}

void Carrier::addScanner(const ScannerProfile& profile, const Mounting& mounting,
                         double turret_rate) {
  // Each scanner gets noise of its own.
  const std::uint64_t seed = seed_ + (static_cast<std::uint64_t>(scanners_.size() + 1) << 32);
  scanners_.push_back({Scanner(profile, mounting, seed), nullptr});
  if (turret_rate == 0.0) return;
  scanners_.back().scanner.mountOn(
      [turret_rate](std::int64_t time) { return turret_rate * 1e-9 * static_cast<double>(time); });
}

void Carrier::addScanner(const ScannerProfile& profile, const Mounting& mounting,
                         const motion::HeadLimits& turret) {
  addScanner(profile, mounting);
  const auto commanded = std::make_shared<Turret>(turret);
  scanners_.back().turret = commanded;
  scanners_.back().scanner.mountOn(
      [commanded](std::int64_t time) { return commanded->angleAt(time); });
}

void Carrier::commandTurret(std::size_t scanner, const motion::HeadCommand& command) {
  if (scanners_[scanner].turret) scanners_[scanner].turret->command(command);
}

void Carrier::addActiveSensor(const ActiveSensorProfile& profile, const Mounting& mounting) {
  const std::uint64_t seed = seed_ + (static_cast<std::uint64_t>(active_sensors_.size() + 1) << 48);
  active_sensors_.push_back({ActiveSensor(profile, seed),
                             triangulation::Ranger(profile.calibrated()),
                             mounting.T_base_sensor()});
}

void Carrier::walk(const GaitConfig& gait) {
  config::validate(gait);
  gait_config_ = gait;
  gait_.emplace(gait, seed_);
  body_motions_.assign(1, gait_->motion());
}

void Carrier::follow(const Path& path) {
  follower_.emplace(path, config_.acceleration);
  departure_ = time_ + std::llround(1e9 * path.wait);
}

void Carrier::command(const Velocity& velocity) {
  command_ = velocity;
  commanded_at_ = time_;
}

void Carrier::commandHead(std::size_t sensor, const motion::HeadCommand& command) {
  active_sensors_[sensor].sensor.command(command);
}

Velocity Carrier::wanted() {
  if (follower_) return time_ < departure_ ? Velocity{} : follower_->steer(robot_.T_map_base());
  const bool is_fresh =
      commanded_at_ && static_cast<double>(time_ - *commanded_at_) < config_.command_timeout * 1e9;
  return is_fresh ? command_ : Velocity{};
}

void Carrier::move() {
  robot_.step(wanted(), 1e-9 * static_cast<double>(kStep));
  time_ += kStep;
  path_.add(time_, robot_.T_map_base());
  if (gait_) {
    walkOn();
  } else if (bumps_) {
    rollOn();
  }
}

void Carrier::walkOn() {
  gait_->step(robot_.velocity().linear, 1e-9 * static_cast<double>(kStep));
  remember(gait_->motion());
}

void Carrier::rollOn() {
  const Velocity& velocity = robot_.velocity();
  const double rate =
      std::abs(velocity.linear) + config_.bumps.wheel_base * std::abs(velocity.angular);
  bumps_->advance(rate * 1e-9 * static_cast<double>(kStep));
  remember({0.0, 0.0, 0.0, {0.0, bumps_->pitch()}});
}

void Carrier::remember(const BodyMotion& motion) {
  constexpr std::size_t kRemembered = 10'000'000'000 / kStep;
  body_motions_.push_back(motion);
  if (body_motions_.size() > kRemembered) body_motions_.pop_front();
}

geometry::Pose2 Carrier::T_map_base(std::int64_t time) const {
  return *path_.at(time) * bodyMotion(time).inPlane();
}

BodyMotion Carrier::bodyMotion(std::int64_t time) const {
  if (body_motions_.empty()) return {};
  const double ago = static_cast<double>(time_ - time) / static_cast<double>(kStep);
  const auto steps = static_cast<std::size_t>(ago);
  const std::size_t last = body_motions_.size() - 1;
  // The trunk stood before it was there as it did first.
  if (steps >= last) return body_motions_.front();
  return interpolate(body_motions_[last - steps], body_motions_[last - steps - 1],
                     ago - static_cast<double>(steps));
}

Eigen::Isometry3d Carrier::inMap(std::int64_t time) const {
  const Eigen::Isometry3d T_map_base = geometry::inSpace(this->T_map_base(time));
  if (body_motions_.empty()) return T_map_base;
  // A robot turns about a point on the floor.
  return T_map_base * bodyMotion(time).outOfPlane(gait_ ? gait_config_.height : 0.0);
}

std::int64_t Carrier::Mounted::nextStamp() const {
  return std::llround(1e9 * static_cast<double>(sweeps) / scanner.profile().rate);
}

void Carrier::measure(const WorldAt& world_at, std::size_t index, Outputs& outputs) {
  sample(world_at, index, outputs);
  turnTurrets(index, outputs);
  sweep(world_at, index, outputs);
  outputs.motions.push_back(inertialMotion(index));
  if (isReportDue()) outputs.states.push_back(report(index));
}

void Carrier::sample(const WorldAt& world_at, std::size_t index, Outputs& outputs) {
  for (std::size_t i = 0; i < active_sensors_.size(); ++i) {
    MountedActiveSensor& mounted = active_sensors_[i];
    const auto T_map_mount = [&](std::int64_t time) { return inMap(time) * mounted.T_base_mount; };
    for (const auto& raw : mounted.sensor.advance(world_at, time_, T_map_mount)) {
      outputs.range_scans.push_back({index, i, mounted.ranger.range(raw)});
    }
    outputs.heads.push_back({index, i, time_, head(i).angle(), head(i).rate()});
  }
}

void Carrier::turnTurrets(std::size_t index, Outputs& outputs) {
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    if (!scanners_[i].turret) continue;
    Turret& turret = *scanners_[i].turret;
    turret.turnUntil(time_);
    outputs.turrets.push_back({index, i, time_, turret.head().angle(), turret.head().rate()});
  }
}

void Carrier::sweep(const WorldAt& world_at, std::size_t index, Outputs& outputs) {
  const auto T_map_base = [this](std::int64_t time) { return inMap(time); };
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    Mounted& mounted = scanners_[i];
    while (mounted.nextStamp() + mounted.scanner.sweepDuration() <= time_) {
      const std::int64_t stamp = mounted.nextStamp();
      ++mounted.sweeps;
      outputs.sweeps.push_back(
          {index, i, mounted.scanner.sweepInSpace(world_at, stamp, T_map_base)});
    }
  }
}

ReportedMotion Carrier::inertialMotion(std::size_t index) const {
  const geometry::Pose2 turned = geometry::between(T_map_base(time_ - kStep), T_map_base(time_));
  return {index, time_, bodyMotion(time_).attitude,
          turned.theta() / (1e-9 * static_cast<double>(kStep))};
}

bool Carrier::isReportDue() const {
  const double due = 1e9 * static_cast<double>(reports_) / odometry_rate_;
  return static_cast<double>(time_) >= due;
}

ReportedState Carrier::report(std::size_t index) {
  const double duration = 1e-9 * static_cast<double>(time_ - last_report_);
  const geometry::UncertainTwist2 twist =
      duration > 0.0 ? robot_.odometry().twist(duration) : geometry::UncertainTwist2{};
  robot_.odometry().beginInterval();
  last_report_ = time_;
  ++reports_;
  return {index, time_, robot_.odometry().pose(), twist, T_map_base(time_), robot_.velocity()};
}

}  // namespace sightline::simulation
