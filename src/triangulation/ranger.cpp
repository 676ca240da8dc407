#include "sightline/triangulation/ranger.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace sightline::triangulation {

std::vector<geometry::Pose2> headMotion(const std::vector<double>& head_angles,
                                        const Eigen::Vector2d& origin,
                                        const std::vector<geometry::Pose2>& mount_motion) {
  const auto turned = [&](double angle) { return angle != head_angles.front(); };
  if (mount_motion.empty() && std::none_of(head_angles.begin(), head_angles.end(), turned)) {
    return {};
  }
  const geometry::Pose2 T_head_projection(origin, 0.0);
  const auto T_mount_projection = [&](std::size_t beam) {
    return geometry::Pose2(0.0, 0.0, head_angles[beam]) * T_head_projection;
  };
  const geometry::Pose2 T_first_mount = T_mount_projection(0).inverse();
  std::vector<geometry::Pose2> motion;
  motion.reserve(head_angles.size());
  for (std::size_t beam = 0; beam < head_angles.size(); ++beam) {
    const geometry::Pose2 moved = mount_motion.empty() ? geometry::Pose2() : mount_motion[beam];
    motion.push_back(T_first_mount * moved * T_mount_projection(beam));
  }
  return motion;
}

Ranger::Ranger(Calibration calibration)
    : calibration_(std::move(calibration)),
      geometry_(calibration_.parameters.scan.geometry(
          calibration_.parameters.origin.projected_vergence)) {}

RangeReading Ranger::read(std::size_t beam, const Photocurrents& currents) const {
  const SensorParameters& parameters = calibration_.parameters;
  RangeReading reading;
  if (!(currents.total() >= parameters.scan.min_current)) return reading;
  const double length = parameters.intrinsics.detector_length;
  const auto found = calibration_.table.lookUp(beam, imagePosition(currents, length));
  const double cosine = geometry_->cosines()[beam];
  const double gain = found.gain / cosine;
  const double sigma = imagePositionSigma(currents.total(), parameters.noise_current, length);
  reading.depth = found.depth - parameters.origin.x;
  reading.range = reading.depth / cosine;
  reading.variance = gain * gain * sigma * sigma;
  reading.kind = scan::classify(reading.range, *geometry_);
  if (found.reach == CalibrationTable::Reach::kNearer) reading.kind = scan::ReturnKind::kTooNear;
  if (found.reach == CalibrationTable::Reach::kFarther) reading.kind = scan::ReturnKind::kNothing;
  return reading;
}

void Ranger::check(const RawScan& raw) const {
  const std::size_t beams = geometry_->beams();
  if (raw.currents.size() != beams) {
    throw scan::InvalidScan(
        fmt::format("{} pairs of photocurrents for {} beams", raw.currents.size(), beams));
  }
  if (raw.head_angles.size() != beams) {
    throw scan::InvalidScan(
        fmt::format("{} head angles for {} beams", raw.head_angles.size(), beams));
  }
  for (const double angle : raw.head_angles) {
    if (!std::isfinite(angle)) throw scan::InvalidScan("a head angle that is not finite");
  }
}

RangeScan Ranger::range(const RawScan& raw) const {
  check(raw);
  RangeScan result;
  result.head_angles = raw.head_angles;
  result.origin = calibration_.parameters.origin.position();
  scan::Scan& scan = result.scan;
  scan.geometry = geometry_;
  scan.stamp = raw.stamp;
  scan.sensor_motion = headMotion(raw.head_angles, result.origin);
  for (std::size_t beam = 0; beam < geometry_->beams(); ++beam) {
    const RangeReading reading = read(beam, raw.currents[beam]);
    scan.ranges.push_back(reading.range);
    scan.kinds.push_back(reading.kind);
    scan.range_variances.push_back(reading.variance);
    scan.intensities.push_back(raw.currents[beam].total());
  }
  return result;
}

}  // namespace sightline::triangulation
