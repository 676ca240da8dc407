#include "sightline/scan/scan.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace sightline::scan {

namespace {

constexpr double kUsualVariance = 0.01 * 0.01;  // [m²]

Eigen::Matrix3d mirrored(const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d sense(1.0, -1.0, -1.0);
  return sense.asDiagonal() * covariance * sense.asDiagonal();
}

}  // namespace

Scan::Scan(std::shared_ptr<const ScanGeometry> geometry, std::int64_t time,
           std::vector<double> ranges, std::vector<double> intensities)
    : stamp(time), geometry_(std::move(geometry)), ranges_(std::move(ranges)) {
  if (!geometry_) throw InvalidScan("no geometry");
  requireLength("ranges", ranges_.size());
  kinds_.reserve(beams());
  for (const double range : ranges_) kinds_.push_back(classify(range, *geometry_));
  range_variances_.assign(beams(), kUsualVariance);
  setIntensities(std::move(intensities));
}

void Scan::requireLength(const char* what, std::size_t length) const {
  const std::size_t wanted = geometry_ ? geometry_->beams() : 0;
  if (length == wanted) return;
  throw InvalidScan(fmt::format("{} {} for {} beams", length, what, wanted));
}

void Scan::setRange(std::size_t beam, double range) {
  ranges_[beam] = range;
  kinds_[beam] = classify(range, *geometry_);
}

void Scan::setRangeVariances(std::vector<double> variances) {
  requireLength("variances", variances.size());
  range_variances_ = std::move(variances);
}

void Scan::setSensorMotion(std::vector<geometry::Pose2> motion) {
  if (!motion.empty()) requireLength("poses of the sensor", motion.size());
  sensor_motion_ = std::move(motion);
  directions_.clear();
  directions_.reserve(sensor_motion_.size());
  for (std::size_t i = 0; i < sensor_motion_.size(); ++i) {
    const Eigen::Vector2d own(geometry_->cosines()[i], geometry_->sines()[i]);
    directions_.emplace_back(sensor_motion_[i].rotation() * own);
  }
}

void Scan::setIntensities(std::vector<double> intensities) {
  if (!intensities.empty()) requireLength("intensities", intensities.size());
  intensities_ = std::move(intensities);
}

Eigen::Vector2d Scan::direction(std::size_t beam) const {
  if (!directions_.empty()) return directions_[beam];
  return {geometry_->cosines()[beam], geometry_->sines()[beam]};
}

Eigen::Vector2d Scan::point(std::size_t beam) const {
  const Eigen::Vector2d own = ranges_[beam] * direction(beam);
  return sensor_motion_.empty() ? own : own + sensor_motion_[beam].translation();
}

Eigen::Matrix2d Scan::covariance(std::size_t beam) const {
  return covariance(beam, direction(beam));
}

Eigen::Matrix2d Scan::covariance(std::size_t beam, const Eigen::Vector2d& along) const {
  const Eigen::Vector2d across(-along.y(), along.x());
  const double across_variance =
      ranges_[beam] * ranges_[beam] * angular_variance + transverse_variance;
  return range_variances_[beam] * along * along.transpose() +
         across_variance * across * across.transpose();
}

std::int64_t Scan::end() const {
  return stamp + std::llround(1e9 * duration());
}

ReturnKind classify(double range, const ScanGeometry& geometry) {
  if (geometry.rangeMin() <= range && range <= geometry.rangeMax() && range > 0.0 &&
      std::isfinite(range)) {
    return ReturnKind::kValid;
  }
  if (range > geometry.rangeMax() || range == std::numeric_limits<double>::infinity()) {
    return ReturnKind::kNothing;
  }
  if (range == -std::numeric_limits<double>::infinity()) return ReturnKind::kTooNear;
  if (range > 0.0 && range < geometry.rangeMin()) return ReturnKind::kTooNear;
  return ReturnKind::kInvalid;
}

Scan mirrored(const Scan& scan, std::shared_ptr<const ScanGeometry> mirrored_geometry) {
  Scan result(std::move(mirrored_geometry), scan.stamp, scan.ranges(), scan.intensities());
  for (std::size_t i = 0; i < scan.beams(); ++i) result.setKind(i, scan.kinds()[i]);
  result.setRangeVariances(scan.rangeVariances());
  std::vector<geometry::Pose2> motion;
  motion.reserve(scan.sensorMotion().size());
  for (const geometry::Pose2& pose : scan.sensorMotion()) {
    motion.emplace_back(pose.x(), -pose.y(), -pose.theta());
  }
  result.setSensorMotion(std::move(motion));
  result.frame = scan.frame;
  result.angular_variance = scan.angular_variance;
  result.transverse_variance = scan.transverse_variance;
  result.motion_noise = scan.motion_noise;
  result.motion_noise.drift = mirrored(scan.motion_noise.drift);
  result.motion_noise.walk = mirrored(scan.motion_noise.walk);
  result.motion_noise.jitter_axis.y() *= -1.0;
  return result;
}

}  // namespace sightline::scan
