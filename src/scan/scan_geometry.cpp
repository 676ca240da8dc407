#include "sightline/scan/scan_geometry.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/geometry/angle.h"

namespace sightline::scan {

namespace {

// A beam more than a turn is a driver that repeats the first one; floats of a message may overshoot
// by a little.
constexpr double kTurn = 2.0 * geometry::kPi + 1e-3;

bool allFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

void checkAngles(const std::vector<double>& angles) {
  if (angles.empty()) throw InvalidScan("no beams");
  if (!allFinite(angles)) throw InvalidScan("an angle that is not finite");
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double step = angles[i] - angles[i - 1];
    if (step == 0.0 || (step > 0.0) != (angles[1] > angles[0])) {
      throw InvalidScan(fmt::format("beam {} does not turn on from the one before", i));
    }
  }
  const double span = std::abs(angles.back() - angles.front());
  if (span > kTurn) throw InvalidScan(fmt::format("beams over {} rad, more than a turn", span));
}

void checkTimes(const std::vector<double>& offsets, std::size_t beams) {
  if (offsets.size() != beams) {
    throw InvalidScan(fmt::format("{} time offsets for {} beams", offsets.size(), beams));
  }
  if (!allFinite(offsets)) throw InvalidScan("a time offset that is not finite");
}

std::vector<double> evenTimes(std::size_t beams, double increment) {
  std::vector<double> offsets(beams);
  for (std::size_t i = 0; i < beams; ++i) offsets[i] = static_cast<double>(i) * increment;
  return offsets;
}

void checkLimits(double range_min, double range_max) {
  if (!(range_min >= 0.0) || !(range_min < range_max)) {
    throw InvalidScan(fmt::format("range limits {} to {} m", range_min, range_max));
  }
}

}  // namespace

ScanGeometry::Directions::Directions(std::vector<double> of) : angles(std::move(of)) {
  checkAngles(angles);
  const std::size_t beams = angles.size();
  increment = beams > 1 ? (angles.back() - angles.front()) / static_cast<double>(beams - 1) : 0.0;
  cosines.reserve(beams);
  sines.reserve(beams);
  for (const double angle : angles) {
    cosines.push_back(std::cos(angle));
    sines.push_back(std::sin(angle));
  }
}

ScanGeometry::ScanGeometry(std::vector<double> angles, std::vector<double> time_offsets,
                           double range_min, double range_max)
    : directions_(std::make_shared<Directions>(std::move(angles))),
      time_offsets_(std::move(time_offsets)),
      range_min_(range_min),
      range_max_(range_max) {
  checkLimits(range_min, range_max);
  checkTimes(time_offsets_, beams());
}

std::shared_ptr<const ScanGeometry> ScanGeometry::withTimeIncrement(double time_increment) const {
  auto result = std::make_shared<ScanGeometry>(*this);
  result->time_offsets_ = evenTimes(beams(), time_increment);
  checkTimes(result->time_offsets_, beams());
  return result;
}

std::shared_ptr<const ScanGeometry> ScanGeometry::uniform(double angle_min, double angle_increment,
                                                          std::size_t beams, double time_increment,
                                                          double range_min, double range_max) {
  if (beams > 1 && (!std::isfinite(angle_increment) || angle_increment == 0.0)) {
    throw InvalidScan(fmt::format("an angle increment of {}", angle_increment));
  }
  std::vector<double> angles(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    angles[i] = i == 0 ? angle_min : angle_min + static_cast<double>(i) * angle_increment;
  }
  return std::make_shared<ScanGeometry>(std::move(angles), evenTimes(beams, time_increment),
                                        range_min, range_max);
}

std::shared_ptr<const ScanGeometry> ScanGeometry::mirrored() const {
  std::vector<double> angles(this->angles());
  for (double& angle : angles) angle = -angle;
  return std::make_shared<ScanGeometry>(std::move(angles), time_offsets_, range_min_, range_max_);
}

bool ScanGeometry::isFullCircle() const {
  const double gap = 2.0 * geometry::kPi - std::abs(angles().back() - angles().front());
  return beams() > 2 && gap < 1.5 * std::abs(angleIncrement());
}

}  // namespace sightline::scan
