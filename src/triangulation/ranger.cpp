#include "sightline/triangulation/ranger.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace sightline::triangulation {

namespace {

constexpr std::size_t kReach = 4;     // beams on either side that may see the same surface
constexpr double kSameSurface = 4.0;  // standard deviations that they may be away

// Median of the image positions around a beam, its own left out; nothing where they are too few, or
// farther than `most` [m] from it.
std::optional<double> neighbouringPosition(const std::vector<double>& positions, std::size_t beam,
                                           double most) {
  std::array<double, 2 * kReach> around;
  std::size_t count = 0;
  const std::size_t end = std::min(positions.size(), beam + kReach + 1);
  for (std::size_t i = beam - std::min(beam, kReach); i < end; ++i) {
    if (i != beam && std::isfinite(positions[i])) around[count++] = positions[i];
  }
  if (count < kReach) return std::nullopt;
  const auto middle = around.begin() + count / 2;
  std::nth_element(around.begin(), middle, around.begin() + count);
  // Of an even number the mean of both middle ones, or it would lean to one side.
  const double below = count % 2 == 1 ? *middle : *std::max_element(around.begin(), middle);
  const double median = 0.5 * (below + *middle);
  if (!(std::abs(median - positions[beam]) <= most)) return std::nullopt;
  return median;
}

}  // namespace

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
  const double p = litPosition(currents);
  return readAt(beam, currents.total(), p, p);
}

double Ranger::litPosition(const Photocurrents& currents) const {
  const SensorParameters& parameters = calibration_.parameters;
  if (!(currents.total() >= parameters.scan.min_current)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return imagePosition(currents, parameters.intrinsics.detector_length);
}

double Ranger::sigma(double current) const {
  const SensorParameters& parameters = calibration_.parameters;
  return imagePositionSigma(current, parameters.noise_current,
                            parameters.intrinsics.detector_length);
}

RangeReading Ranger::readAt(std::size_t beam, double current, double p, double p_of_gain) const {
  RangeReading reading;
  if (std::isnan(p)) return reading;
  const CalibrationTable& table = calibration_.table;
  const auto found = table.lookUp(beam, p);
  const double gain = p == p_of_gain ? found.gain : table.lookUp(beam, p_of_gain).gain;
  const double cosine = geometry_->cosines()[beam];
  reading.depth = found.depth - calibration_.parameters.origin.x;
  reading.range = reading.depth / cosine;
  reading.variance = std::pow(gain / cosine * sigma(current), 2);
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
  std::vector<double> positions;
  positions.reserve(raw.currents.size());
  for (const Photocurrents& currents : raw.currents) positions.push_back(litPosition(currents));
  for (std::size_t beam = 0; beam < geometry_->beams(); ++beam) {
    const double current = raw.currents[beam].total();
    const double p = positions[beam];
    const double around =
        neighbouringPosition(positions, beam, kSameSurface * sigma(current)).value_or(p);
    const RangeReading reading = readAt(beam, current, p, around);
    scan.ranges.push_back(reading.range);
    scan.kinds.push_back(reading.kind);
    scan.range_variances.push_back(reading.variance);
    scan.intensities.push_back(current);
  }
  return result;
}

}  // namespace sightline::triangulation
