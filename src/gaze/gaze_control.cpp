#include "sightline/gaze/gaze_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace sightline::gaze {

namespace {

using geometry::Pose2;
using motion::HeadCommand;

constexpr std::int64_t kSecond = 1'000'000'000;
// A command is repeated so often, as one may be lost [ns].
constexpr std::int64_t kRepeat = kSecond / 2;
// A clock that goes back by more was set [ns].
constexpr std::int64_t kSetBack = kSecond / 2;

GazeConfig checkedGaze(const GazeConfig& config) {
  config.check("");
  return config;
}

std::int64_t nanosecondsOf(double seconds) {
  return std::llround(1e9 * seconds);
}

}  // namespace

GazeControl::GazeControl(const GazeConfig& config)
    : config_(checkedGaze(config)),
      watch_(config_.head, config_.answer),
      motion_(config_.patience),
      informing_(config_, motion_) {
  state_.mode = config_.mode;
}

void GazeControl::takeOdometry(std::int64_t stamp, const Pose2& T_odom_base) {
  motion_.add(stamp, T_odom_base);
}

void GazeControl::takePose(std::int64_t stamp, const geometry::UncertainPose2& T_map_base) {
  informing_.takePose(stamp, T_map_base);
}

void GazeControl::takeFeatures(std::int64_t stamp, const std::vector<geometry::Feature>& features) {
  features_ = features;
  features_stamp_ = stamp;
  if (fixation_) fixation_->see(features_, stamp);
}

void GazeControl::takeHead(std::int64_t now, double angle) {
  watch_.report(angle, now);
  if (interrupted_) setMode(*std::exchange(interrupted_, std::nullopt));
}

void GazeControl::takeScan(const scan::Scan& scan, const Pose2& T_mount_sensor) {
  if (T_base_mount_) informing_.takeScan(scan, *T_base_mount_, T_mount_sensor);
}

void GazeControl::setMode(GazeMode mode) {
  state_ = GazeState{};
  state_.mode = mode;
  if (mode != GazeMode::kFixate) fixation_.reset();
  commanded_.reset();
  interrupted_.reset();
  informing_.chooseAnew();
  if (now_) watch_.restart(*now_);
}

void GazeControl::hold() {
  setMode(GazeMode::kHold);
}

void GazeControl::sweep() {
  setMode(GazeMode::kSweep);
}

void GazeControl::inform() {
  setMode(GazeMode::kInform);
}

Fixated GazeControl::fixate(const geometry::Feature* feature, const std::string& fault) {
  if (!feature) return {false, 0, fault};
  setMode(GazeMode::kFixate);
  fixation_.emplace(*feature, *features_stamp_, config_);
  state_.target = feature->id;
  is_nearest_ = false;
  return {true, feature->id, ""};
}

Fixated GazeControl::fixate(std::uint32_t id) {
  return fixate(FeatureChoice(features_, {}, config_).byId(id),
                fmt::format("there is no feature {}", id));
}

Fixated GazeControl::fixateAt(const Eigen::Vector2d& place_odom) {
  return fixate(
      FeatureChoice(features_, {}, config_).at(place_odom),
      fmt::format("there is no feature within {:.2f} m of that point", config_.click_radius));
}

Fixated GazeControl::fixateNearestCorner() {
  const auto T_odom_base = motion_.newest();
  if (!T_odom_base || !T_base_mount_) return {false, 0, "the place of the head is not known"};
  const FeatureChoice choice(features_, *T_odom_base * *T_base_mount_, config_);
  const Fixated fixated = fixate(choice.nearestCorner(), "there is no corner within reach");
  is_nearest_ = fixated.success;
  return fixated;
}

Fixated GazeControl::fixateMostInformative() {
  const auto T_odom_base = motion_.newest();
  if (!T_odom_base || !T_base_mount_) return {false, 0, "the place of the head is not known"};
  // Without a pose all directions are as uncertain.
  Eigen::Matrix3d covariance = 1e-2 * Eigen::Matrix3d::Identity();
  if (const auto& pose = informing_.pose()) {
    const Eigen::Matrix2d R = Pose2(0.0, 0.0, T_odom_base->theta() - pose->mean.theta()).rotation();
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = R;
    covariance = turn * pose->covariance * turn.transpose();
  }
  const FeatureChoice choice(features_, *T_odom_base * *T_base_mount_, config_);
  return fixate(choice.mostInformative(covariance), "there is no fixed feature within reach");
}

bool GazeControl::isFresh(const std::optional<std::int64_t>& stamp, std::int64_t now) const {
  return stamp && now - *stamp <= nanosecondsOf(config_.patience);
}

double GazeControl::rest(const std::string& reason) {
  state_.rests = true;
  state_.message = reason;
  return config_.rest;
}

double GazeControl::wantedSweeping() {
  const double limit = sweep_sense_ > 0.0 ? config_.head.upper : config_.head.lower;
  const auto angle = watch_.angle();
  if (angle && std::abs(*angle - limit) < 2.0 * config_.head.resolution) sweep_sense_ *= -1.0;
  return sweep_sense_ > 0.0 ? config_.head.upper : config_.head.lower;
}

std::optional<double> GazeControl::wantedFixating(std::int64_t now) {
  if (!motion_.isFresh(now)) return rest("no odometry");
  if (!isFresh(features_stamp_, now)) return rest("no features");
  if (!T_base_mount_) return rest("the mounting of the head is not known");
  if (!fixation_ && !fixateNearestCorner().success) return rest("there is no corner within reach");
  if (fixation_->unseen(now) > config_.give_up) {
    hold();
    state_.message = "the feature was not found again";
    return std::nullopt;
  }
  state_.target = fixation_->id();
  state_.is_target_lost = fixation_->isLost(now);
  state_.place = fixation_->position();
  const std::int64_t then = now + nanosecondsOf(config_.lead);
  return fixation_->aim(*motion_.at(then) * *T_base_mount_, then);
}

std::optional<double> GazeControl::wantedInforming(std::int64_t now) {
  const auto choice = informing_.choose(now, T_base_mount_, watch_.angle().value_or(config_.rest));
  return choice.angle ? choice.angle : rest(choice.fault);
}

std::optional<double> GazeControl::wanted(std::int64_t now) {
  const std::string fault = std::exchange(state_.message, "");
  state_.rests = false;
  switch (state_.mode) {
    case GazeMode::kSweep:
      return wantedSweeping();
    case GazeMode::kFixate:
      return wantedFixating(now);
    case GazeMode::kInform:
      return wantedInforming(now);
    case GazeMode::kHold:
      break;
  }
  state_.message = fault;  // why it holds
  return std::nullopt;
}

void GazeControl::restartClock(std::int64_t now) {
  motion_.clear();
  informing_.clearPose();
  features_.clear();
  features_stamp_.reset();
  const bool was_fixating = fixation_.has_value();
  fixation_.reset();
  if (was_fixating) {
    hold();
    state_.message = "the clock was set back";
  }
  commanded_.reset();
  watch_.restart(now);
}

// A head at fault is left alone, until somebody tries again. One that had not answered, as before
// its driver runs, and now does goes on with what needs no feature that was chosen before.
bool GazeControl::watchHead(std::int64_t now) {
  const std::string fault = watch_.fault(now);
  if (fault.empty()) return true;
  const GazeMode mode = state_.mode;
  const bool may_go_on = watch_.isSilent(now) && (!fixation_ || is_nearest_);
  hold();
  state_.message = fault;
  if (may_go_on) interrupted_ = mode;
  return false;
}

std::optional<HeadCommand> GazeControl::decide(std::int64_t now) {
  if (now_ && now + kSetBack < *now_) restartClock(now);
  now_ = now;
  if (!watchHead(now)) return HeadCommand{};
  const auto angle = wanted(now);
  if (!angle) return std::nullopt;
  return command(*angle, now);
}

std::optional<HeadCommand> GazeControl::command(double angle, std::int64_t now) {
  HeadCommand command;
  command.mode = HeadCommand::Mode::kPosition;
  command.position =
      config_.head.rounded(std::clamp(angle, config_.head.lower, config_.head.upper));
  command.rate =
      state_.mode == GazeMode::kSweep ? std::min(config_.sweep_rate, config_.head.max_rate) : 0.0;
  state_.wanted = command.position;
  const bool is_same =
      commanded_ && std::abs(*commanded_ - command.position) < 0.5 * config_.head.resolution;
  if (is_same && now - commanded_at_ < kRepeat) return std::nullopt;
  commanded_ = command.position;
  commanded_at_ = now;
  watch_.command(command.position, now);
  return command;
}

}  // namespace sightline::gaze
