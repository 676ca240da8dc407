#include "sightline/targets/target_tracker.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>

namespace sightline::targets {

namespace {

std::unique_ptr<TargetFilter> makeFilter(const TargetTrackerConfig& config) {
  if (config.method == FilterMethod::kPhd) return std::make_unique<PhdFilter>(config.phd);
  return std::make_unique<BernoulliFilter>(config.bernoulli);
}

std::int64_t toNanoseconds(double seconds) {
  return std::llround(1e9 * seconds);
}

bool isCovariance(const Eigen::Matrix3d& covariance) {
  constexpr double kRounding = -1e-12;
  return covariance.allFinite() && covariance.diagonal().minCoeff() >= kRounding &&
         covariance.determinant() >= kRounding;
}

}  // namespace

TargetTracker::TargetTracker(const TargetTrackerConfig& config)
    : config_(config), filter_(makeFilter(config)) {
  config::validate(config_);
  if (!config_.models.empty()) models_ = SensorModelsConfig::readFile(config_.models);
  sight_ = worldSight(config_.world, config_.sensor_height);
}

void TargetTracker::reset() {
  filter_ = makeFilter(config_);
  robots_.clear();
  newest_ = 0;
}

TargetTracker::Robot& TargetTracker::robotOf(const std::string& name) {
  const auto found = robots_.find(name);
  if (found != robots_.end()) return found->second;
  const auto model = models_.robots.find(name);
  const SensorModelConfig& config = model == models_.robots.end() ? models_.common : model->second;
  return robots_.emplace(name, Robot{robots_.size(), SensorModel(config, sight_), {}, 0, {}, 0})
      .first->second;
}

std::string TargetTracker::faultOf(const BearingSet& set) const {
  if (set.stamp <= 0) return "a stamp of zero";
  if (!(set.field_of_view.width() > 0.0)) return "no field of view";
  if (!(set.sigma >= 0.0) || !std::isfinite(set.sigma)) {
    return "a negative or missing standard deviation";
  }
  if (!(set.range_max > 0.0)) return "no range";
  for (const double bearing : set.bearings) {
    if (!std::isfinite(bearing)) return "a bearing that is not finite";
    if (std::abs(bearing) > 2.0 * geometry::kPi) return "a bearing beyond a turn";
  }
  if (!set.T_map_sensor.mean.isFinite()) return "a pose that is not finite";
  if (!isCovariance(set.T_map_sensor.covariance)) return "a pose whose covariance is none";
  if (set.stamp < newest_ - toNanoseconds(config_.max_age)) {
    return fmt::format("{:.1f} s older than the newest look",
                       1e-9 * static_cast<double>(newest_ - set.stamp));
  }
  return "";
}

bool TargetTracker::isNew(const Robot& robot, const BearingSet& set) const {
  if (!robot.counted) return true;
  const geometry::Pose2 moved = geometry::between(*robot.counted, set.T_map_sensor.mean);
  return moved.translation().norm() >= config_.spacing.distance ||
         std::abs(moved.theta()) >= config_.spacing.turn ||
         set.stamp - robot.counted_stamp >= toNanoseconds(config_.spacing.rest);
}

// Where robots were at about the same time, and where those were that have fallen silent since.
void TargetTracker::addMates(const Robot& robot, BearingSet& set) const {
  constexpr std::int64_t kSameTime = 1'000'000'000;
  if (!config_.explain_mates) return;
  for (const auto& [name, mate] : robots_) {
    if (mate.index == robot.index) continue;
    UncertainPoint point{mate.T_map_sensor.mean.translation(),
                         mate.T_map_sensor.covariance.topLeftCorner<2, 2>()};
    point.covariance.diagonal().array() += config_.mate_sigma * config_.mate_sigma;
    if (mate.stamp < set.stamp - kSameTime) {
      set.lost.push_back({mate.index, point, mate.stamp});
    } else if (mate.stamp <= set.stamp + kSameTime) {
      set.known.push_back(point);
    }
  }
}

TargetTracker::Verdict TargetTracker::take(const std::string& name, BearingSet set) {
  const std::string fault = faultOf(set);
  if (!fault.empty()) return {LookOutcome::kRefused, fault};
  Robot& robot = robotOf(name);
  newest_ = std::max(newest_, set.stamp);
  if (set.stamp >= robot.stamp) {
    robot.stamp = set.stamp;
    robot.T_map_sensor = set.T_map_sensor;
  }
  if (!isNew(robot, set)) return {LookOutcome::kSpared, ""};
  robot.counted = set.T_map_sensor.mean;
  robot.counted_stamp = set.stamp;
  set.robot = robot.index;
  addMates(robot, set);
  filter_->update(set, robot.model);
  return {LookOutcome::kUsed, ""};
}

}  // namespace sightline::targets
