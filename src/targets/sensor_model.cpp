#include "sightline/targets/sensor_model.h"

#include <algorithm>
#include <cmath>

namespace sightline::targets {

namespace {

double normalDensity(double error, double sigma) {
  const double scaled = error / sigma;
  return std::exp(-0.5 * scaled * scaled) / (sigma * std::sqrt(2.0 * geometry::kPi));
}

double peakDensity(const ClutterConfig& clutter) {
  if (clutter.uniform_share == 1.0) return 0.0;
  return (1.0 - clutter.uniform_share) * clutter.mean / (2.0 * clutter.peak_width);
}

}  // namespace

Polar polarOf(const Eigen::Vector2d& point_sensor) {
  return {point_sensor.norm(), std::atan2(point_sensor.y(), point_sensor.x())};
}

double kneeRange(const DetectionConfig& detection) {
  return detection.target_diameter / detection.beam_spacing;
}

SensorModel::SensorModel(const SensorModelConfig& config, std::shared_ptr<const LineOfSight> sight)
    : config_(config), sight_(std::move(sight)), knee_(kneeRange(config.detection)) {
  config_.check();
  uniform_density_ =
      config_.clutter.uniform_share * config_.clutter.mean / config_.field_of_view.width();
  peak_density_ = peakDensity(config_.clutter);
}

bool SensorModel::isInView(const Polar& target) const {
  return target.range >= config_.detection.range_min &&
         target.range <= config_.detection.range_max &&
         config_.field_of_view.contains(target.bearing);
}

double SensorModel::detection(const Polar& target) const {
  if (!isInView(target)) return 0.0;
  if (config_.detection.table) return config_.detection.table->at(target.range, target.bearing);
  const double covered = target.range > knee_ ? knee_ / target.range : 1.0;
  return (1.0 - config_.detection.false_negative) * covered;
}

double SensorModel::detection(const Eigen::Vector2d& target_map,
                              const geometry::Pose2& T_map_sensor) const {
  const double detected = detection(polarOf(T_map_sensor.inverse() * target_map));
  return detected > 0.0 && isInSight(target_map, T_map_sensor) ? detected : 0.0;
}

bool SensorModel::isInSight(const Eigen::Vector2d& target_map,
                            const geometry::Pose2& T_map_sensor) const {
  return !sight_ || sight_->isClear(T_map_sensor.translation(), target_map);
}

double SensorModel::likelihood(double bearing, const Polar& target) const {
  const double error =
      geometry::wrapAngle(bearing - target.bearing - config_.bearing.biasAt(target.bearing));
  double density = 0.0;
  for (const double turn : {-2.0, 0.0, 2.0}) {
    density += normalDensity(error + turn * geometry::kPi, config_.bearing.sigma);
  }
  return density;
}

double SensorModel::clutter(double bearing, const geometry::Pose2&) const {
  if (!config_.field_of_view.contains(bearing)) return 0.0;
  const double off_side = std::abs(std::abs(bearing) - 0.5 * geometry::kPi);
  return uniform_density_ + (off_side <= 0.5 * config_.clutter.peak_width ? peak_density_ : 0.0);
}

}  // namespace sightline::targets
