#include "sightline/scan/scan.h"

#include <cmath>
#include <limits>

namespace sightline::scan {

Eigen::Vector2d Scan::direction(std::size_t beam) const {
  const Eigen::Vector2d own(geometry->cosines()[beam], geometry->sines()[beam]);
  return sensor_motion.empty() ? own : sensor_motion[beam].rotation() * own;
}

Eigen::Vector2d Scan::point(std::size_t beam) const {
  const Eigen::Vector2d own(ranges[beam] * geometry->cosines()[beam],
                            ranges[beam] * geometry->sines()[beam]);
  return sensor_motion.empty() ? own : sensor_motion[beam] * own;
}

Eigen::Matrix2d Scan::covariance(std::size_t beam) const {
  const Eigen::Vector2d along = direction(beam);
  const Eigen::Vector2d across(-along.y(), along.x());
  const double across_variance =
      ranges[beam] * ranges[beam] * angular_variance + transverse_variance;
  return range_variances[beam] * along * along.transpose() +
         across_variance * across * across.transpose();
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

}  // namespace sightline::scan
