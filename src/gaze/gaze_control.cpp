#include "sightline/gaze/gaze_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sightline/motion/odometry_noise.h"

namespace sightline::gaze {

namespace {

using geometry::Pose2;
using motion::HeadCommand;

constexpr std::int64_t kSecond = 1'000'000'000;
// A command is repeated so often, as one may be lost [ns].
constexpr std::int64_t kRepeat = kSecond / 2;
// Time over which the velocity of the carrier is taken [ns].
constexpr std::int64_t kVelocitySpan = 60'000'000;
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
      informative_(config_),
      visibility_(config_.inform.forget) {
  state_.mode = config_.mode;
}

void GazeControl::setMap(world::RoomMap map) {
  map_ = std::move(map);
  visibility_.clear();
}

void GazeControl::takeOdometry(std::int64_t stamp, const Pose2& T_odom_base) {
  odometry_.add(stamp, T_odom_base);
}

void GazeControl::takePose(std::int64_t stamp, const geometry::UncertainPose2& T_map_base) {
  pose_ = Stamped{stamp, T_map_base};
}

void GazeControl::takeFeatures(std::int64_t stamp, const std::vector<geometry::Feature>& features) {
  features_ = features;
  features_stamp_ = stamp;
  if (fixation_) fixation_->see(features_, stamp);
}

void GazeControl::takeHead(std::int64_t now, double angle) {
  watch_.report(angle, now);
}

void GazeControl::takeScan(const scan::Scan& scan, const Pose2& T_mount_sensor) {
  if (!map_ || !T_base_mount_ || map_->rooms().empty()) return;
  const auto T_map_base = T_map_baseAt(scan.stamp);
  if (!T_map_base) return;
  const Pose2 T_map_sensor = T_map_base->mean * *T_base_mount_ * T_mount_sensor;
  const double elapsed = 1e-9 * static_cast<double>(std::max<std::int64_t>(
                                    0, scan.stamp - std::exchange(scanned_at_, scan.stamp)));
  visibility_.take(scan, *map_, map_->nearestRoom(T_map_base->mean.translation()), T_map_sensor,
                   std::min(elapsed, 10.0));
}

void GazeControl::setMode(GazeMode mode) {
  state_ = GazeState{};
  state_.mode = mode;
  if (mode != GazeMode::kFixate) fixation_.reset();
  commanded_.reset();
  chosen_at_ = 0;
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
  const auto T_odom_base = odometry_.empty() ? std::nullopt : odometry_.at(odometry_.newest());
  if (!T_odom_base || !T_base_mount_) return {false, 0, "the place of the head is not known"};
  const FeatureChoice choice(features_, *T_odom_base * *T_base_mount_, config_);
  return fixate(choice.nearestCorner(), "there is no corner within reach");
}

Fixated GazeControl::fixateMostInformative() {
  const auto T_odom_base = odometry_.empty() ? std::nullopt : odometry_.at(odometry_.newest());
  if (!T_odom_base || !T_base_mount_) return {false, 0, "the place of the head is not known"};
  // Without a pose all directions are as uncertain.
  Eigen::Matrix3d covariance = 1e-2 * Eigen::Matrix3d::Identity();
  if (pose_) {
    const Eigen::Matrix2d R =
        Pose2(0.0, 0.0, T_odom_base->theta() - pose_->T_map_base.mean.theta()).rotation();
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = R;
    covariance = turn * pose_->T_map_base.covariance * turn.transpose();
  }
  const FeatureChoice choice(features_, *T_odom_base * *T_base_mount_, config_);
  return fixate(choice.mostInformative(covariance), "there is no fixed feature within reach");
}

Eigen::Vector3d GazeControl::twist() const {
  if (odometry_.empty()) return Eigen::Vector3d::Zero();
  const std::int64_t newest = odometry_.newest();
  const std::int64_t before = std::max(odometry_.oldest(), newest - kVelocitySpan);
  if (before == newest) return Eigen::Vector3d::Zero();
  return geometry::between(*odometry_.at(before), *odometry_.at(newest)).log() /
         (1e-9 * static_cast<double>(newest - before));
}

// Beyond the newest report by constant velocity, as long as that is fresh.
std::optional<Pose2> GazeControl::T_odom_baseAt(std::int64_t stamp) const {
  if (odometry_.empty()) return std::nullopt;
  if (stamp <= odometry_.newest()) return odometry_.at(stamp);
  const double ahead = 1e-9 * static_cast<double>(stamp - odometry_.newest());
  return *odometry_.at(odometry_.newest()) *
         Pose2::exp(std::min(ahead, config_.patience) * twist());
}

std::optional<geometry::UncertainPose2> GazeControl::T_map_baseAt(std::int64_t stamp) const {
  if (!pose_) return std::nullopt;
  const auto before = T_odom_baseAt(pose_->stamp);
  const auto at = T_odom_baseAt(stamp);
  if (!before || !at) return std::nullopt;
  const Pose2 step = geometry::between(*before, *at);
  return geometry::compose(pose_->T_map_base,
                           {step, motion::stepCovariance(config_.odometry, step)});
}

bool GazeControl::isFresh(const std::optional<std::int64_t>& stamp, std::int64_t now) const {
  return stamp && now - *stamp <= nanosecondsOf(config_.patience);
}

bool GazeControl::isOdometryFresh(std::int64_t now) const {
  return !odometry_.empty() && isFresh(odometry_.newest(), now);
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
  if (!isOdometryFresh(now)) return rest("no odometry");
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
  return fixation_->aim(*T_odom_baseAt(then) * *T_base_mount_, then);
}

std::optional<double> GazeControl::wantedInforming(std::int64_t now) {
  if (!map_ || map_->rooms().empty()) return rest("no map");
  if (!T_base_mount_) return rest("the mounting of the head is not known");
  if (!pose_ || !isFresh(pose_->stamp, now)) return rest("no pose");
  const auto T_map_base = T_map_baseAt(now);
  if (!T_map_base) return rest("no odometry");
  if (now - chosen_at_ >= nanosecondsOf(config_.inform.period)) {
    chosen_at_ = now;
    const LookingPlace place{*T_map_base, *T_base_mount_,
                             map_->nearestRoom(T_map_base->mean.translation()),
                             watch_.angle().value_or(config_.rest), twist()};
    look_ = informative_.choose(place, *map_, visibility_);
  }
  if (!look_.has_walls) return rest("no wall of the map is within reach");
  return look_.angle;
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
  odometry_.clear();
  pose_.reset();
  features_.clear();
  features_stamp_.reset();
  const bool was_fixating = fixation_.has_value();
  fixation_.reset();
  if (was_fixating) {
    hold();
    state_.message = "the clock was set back";
  }
  commanded_.reset();
  chosen_at_ = 0;
  scanned_at_ = 0;
  watch_.restart(now);
}

// A head at fault is left alone, until somebody tries again.
bool GazeControl::watchHead(std::int64_t now) {
  const std::string fault = watch_.fault(now);
  if (fault.empty()) return true;
  hold();
  state_.message = fault;
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
