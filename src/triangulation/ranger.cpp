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
  // The mean of both middle ones of an even number; one of them would lean to one side.
  const double below = count % 2 == 1 ? *middle : *std::max_element(around.begin(), middle);
  const double median = 0.5 * (below + *middle);
  if (!(std::abs(median - positions[beam]) <= most)) return std::nullopt;
  return median;
}

// The readings of a scan, beam by beam.
struct Readings {
  std::vector<double> ranges;
  std::vector<double> currents;
  std::vector<double> variances;
  std::vector<scan::ReturnKind> kinds;

  void add(const RangeReading& reading, double current) {
    ranges.push_back(reading.range);
    currents.push_back(current);
    variances.push_back(reading.variance);
    kinds.push_back(reading.kind);
  }
  scan::Scan toScan(const std::shared_ptr<const scan::ScanGeometry>& geometry, std::int64_t stamp) {
    scan::Scan scan(geometry, stamp, std::move(ranges), std::move(currents));
    // The calibration table tells too near and too far as well.
    for (std::size_t i = 0; i < scan.beams(); ++i) scan.setKind(i, kinds[i]);
    scan.setRangeVariances(std::move(variances));
    return scan;
  }
};

}  // namespace

Ranger::Ranger(Calibration calibration)
    : calibration_(std::move(calibration)),
      geometry_(calibration_.parameters.scan.geometry(
          calibration_.parameters.origin.projected_vergence)) {}

RangeReading Ranger::read(std::size_t beam, const Photocurrents& currents) const {
  const double p = litPosition(currents);
  return readAt(beam, currents.total(), p, p);
}

std::vector<Photocurrents> Ranger::withoutLag(const std::vector<Photocurrents>& measured) const {
  const double memory = calibration_.parameters.scan.memory();
  if (memory == 0.0) return measured;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<Photocurrents> currents{{kUnknown, kUnknown}};
  for (std::size_t i = 1; i < measured.size(); ++i) {
    const auto ahead = [&](double now, double before) {
      return (now - memory * before) / (1.0 - memory);
    };
    currents.push_back({ahead(measured[i].first, measured[i - 1].first),
                        ahead(measured[i].second, measured[i - 1].second)});
  }
  return currents;
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
  const double memory = parameters.scan.memory();
  const double noise_current =
      parameters.noise_current * std::sqrt((1.0 + memory) / (1.0 - memory));
  return imagePositionSigma(current, noise_current, parameters.intrinsics.detector_length);
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

motion::RangeScan Ranger::range(const RawScan& raw) const {
  check(raw);
  motion::RangeScan result;
  result.head.angles = raw.head_angles;
  result.head.origin = calibration_.parameters.origin.position();
  std::vector<double> positions;
  const auto currents = withoutLag(raw.currents);
  positions.reserve(currents.size());
  for (const Photocurrents& pair : currents) positions.push_back(litPosition(pair));
  Readings readings;
  for (std::size_t beam = 0; beam < geometry_->beams(); ++beam) {
    const double current = currents[beam].total();
    const double p = positions[beam];
    const double around =
        neighbouringPosition(positions, beam, kSameSurface * sigma(current)).value_or(p);
    readings.add(readAt(beam, current, p, around), current);
  }
  result.scan = readings.toScan(geometry_, raw.stamp);
  result.scan.setSensorMotion(motion::headMotion(result.head));
  return result;
}

}  // namespace sightline::triangulation
