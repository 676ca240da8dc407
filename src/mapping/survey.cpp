#include "sightline/mapping/survey.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double spacing = 0.3;        // between key scans [m]
  double turn = 0.26;          // 15° [rad]
  double farthest_miss = 8.0;  // a beam that met nothing tells of free space up to here [m]
  std::size_t most_misses = 90;
} kSurvey;

const std::optional<Pose2>& byWheels(const pipeline::LocatedScan& located) {
  return located.T_path_base ? located.T_path_base : located.T_odom_base;
}

std::vector<Eigen::Vector2d> missesOf(const scan::Scan& scan, const Pose2& T_base_sensor) {
  std::vector<Eigen::Vector2d> ends;
  const std::size_t stride = scan.beams() / kSurvey.most_misses + 1;
  const double range = std::min(kSurvey.farthest_miss, scan.geometry()->rangeMax());
  for (std::size_t i = 0; i < scan.beams(); i += stride) {
    if (scan.kinds()[i] != scan::ReturnKind::kNothing) continue;
    ends.push_back(T_base_sensor * Eigen::Vector2d(range * scan.direction(i)));
  }
  return ends;
}

}  // namespace

Survey::Survey(const pipeline::EstimatorsConfig& config)
    : estimators_(std::make_unique<pipeline::Estimators>(
          config, pipeline::EstimatorSet{false, false, true})) {}

void Survey::take(pipeline::LocatedScan located) {
  if (located.scanner != 0) return;
  const pipeline::Estimates estimates = estimators_->take(std::move(located));
  if (!estimates.odometry) return;
  wheels_broke_ = wheels_broke_ || estimates.located.odometry_broke;
  advance(*estimates.odometry);
  const Pose2& T_odom_base = estimates.odometry->pose.mean;
  if (isNew(T_odom_base)) addKey(estimates.located, T_odom_base);
  path_.push_back({estimates.odometry->stamp, T_odom_base, keys_.size() - 1,
                   byWheels(estimates.located), estimates.located.odometry_broke});
}

void Survey::advance(const dead_reckoning::DeadReckoningUpdate& update) {
  if (update.isFlagged()) ++bridged_;
  if (path_.empty()) return;
  step_ = geometry::compose(step_, update.step);
  way_ += update.step.mean.translation().norm();
}

bool Survey::isNew(const Pose2& T_odom_base) const {
  if (keys_.empty()) return true;
  const Pose2 step = geometry::between(keys_.back().T_odom_base, T_odom_base);
  return step.translation().norm() > kSurvey.spacing || std::abs(step.theta()) > kSurvey.turn;
}

void Survey::addKey(const pipeline::LocatedScan& located, const Pose2& T_odom_base) {
  const Pose2 T_base_sensor = located.T_base_sensor.value_or(Pose2());
  KeyScan key;
  key.T_odom_base = T_odom_base;
  key.step = step_;
  if (!keys_.empty()) key.step.mean = geometry::between(keys_.back().T_odom_base, T_odom_base);
  key.wheel_step = wheelStep(located);
  key.way = way_;
  key.surfaces = dead_reckoning::readSurfaces(located.scan, T_base_sensor, Eigen::Vector3d::Zero());
  key.misses = missesOf(located.scan, T_base_sensor);
  keys_.push_back(std::move(key));
  step_ = {};
}

std::optional<Pose2> Survey::wheelStep(const pipeline::LocatedScan& located) {
  const auto before = T_wheels_key_;
  const bool broke = wheels_broke_;
  T_wheels_key_ = byWheels(located);
  wheels_broke_ = false;
  if (!before || !T_wheels_key_ || broke) return std::nullopt;
  return geometry::between(*before, *T_wheels_key_);
}

std::size_t Survey::withWheels() const {
  return static_cast<std::size_t>(std::count_if(
      keys_.begin(), keys_.end(), [](const KeyScan& key) { return key.wheel_step.has_value(); }));
}

}  // namespace sightline::mapping
