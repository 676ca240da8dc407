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

void checkLimits(double range_min, double range_max) {
  if (!(range_min >= 0.0) || !(range_min < range_max)) {
    throw InvalidScan(fmt::format("range limits {} to {} m", range_min, range_max));
  }
}

}  // namespace

ScanGeometry::ScanGeometry(std::vector<double> angles, std::vector<double> time_offsets,
                           double range_min, double range_max)
    : angles_(std::move(angles)),
      time_offsets_(std::move(time_offsets)),
      range_min_(range_min),
      range_max_(range_max) {
  checkAngles(angles_);
  checkLimits(range_min, range_max);
  if (time_offsets_.size() != angles_.size()) {
    throw InvalidScan(
        fmt::format("{} time offsets for {} beams", time_offsets_.size(), angles_.size()));
  }
  if (!allFinite(time_offsets_)) throw InvalidScan("a time offset that is not finite");
  angle_increment_ =
      beams() > 1 ? (angles_.back() - angles_.front()) / static_cast<double>(beams() - 1) : 0.0;
  cosines_.reserve(beams());
  sines_.reserve(beams());
  for (const double angle : angles_) {
    cosines_.push_back(std::cos(angle));
    sines_.push_back(std::sin(angle));
  }
}

std::shared_ptr<const ScanGeometry> ScanGeometry::uniform(double angle_min, double angle_increment,
                                                          std::size_t beams, double time_increment,
                                                          double range_min, double range_max) {
  if (beams > 1 && (!std::isfinite(angle_increment) || angle_increment == 0.0)) {
    throw InvalidScan(fmt::format("an angle increment of {}", angle_increment));
  }
  std::vector<double> angles(beams);
  std::vector<double> offsets(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const auto index = static_cast<double>(i);
    angles[i] = i == 0 ? angle_min : angle_min + index * angle_increment;
    offsets[i] = index * time_increment;
  }
  return std::make_shared<ScanGeometry>(std::move(angles), std::move(offsets), range_min,
                                        range_max);
}

std::shared_ptr<const ScanGeometry> ScanGeometry::mirrored() const {
  std::vector<double> angles(angles_);
  for (double& angle : angles) angle = -angle;
  return std::make_shared<ScanGeometry>(std::move(angles), time_offsets_, range_min_, range_max_);
}

bool ScanGeometry::isFullCircle() const {
  const double gap = 2.0 * geometry::kPi - std::abs(angles_.back() - angles_.front());
  return beams() > 2 && gap < 1.5 * std::abs(angle_increment_);
}

}  // namespace sightline::scan
