#include "sightline/driver/scan_report_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::driver {

namespace {

// Marks the status where the current does not fit.
std::int32_t toCount(double current, ScanReport& report) {
  const double count = current / (1e-15 * report.femtoamperes_per_count);
  if (std::abs(count) > kMaxCount) report.status |= ScanReport::kSaturated;
  return static_cast<std::int32_t>(std::lround(std::clamp<double>(count, -kMaxCount, kMaxCount)));
}

std::int16_t toAngleUnits(double angle) {
  using Limits = std::numeric_limits<std::int16_t>;
  return static_cast<std::int16_t>(
      std::lround(std::clamp<double>(angle / kAngleUnit, Limits::min(), Limits::max())));
}

// Current of a count [A]; NaN at an end of the count, where it may be anything beyond.
double currentOf(std::int32_t count, double ampere) {
  if (std::abs(count) >= kMaxCount) return std::numeric_limits<double>::quiet_NaN();
  return ampere * count;
}

}  // namespace

void toRawScan(const ScanReport& report, triangulation::RawScan& raw) {
  const double ampere = 1e-15 * report.femtoamperes_per_count;
  raw.currents.clear();
  for (const ScanReport::Counts& pair : report.currents) {
    raw.currents.push_back({currentOf(pair.first, ampere), currentOf(pair.second, ampere)});
  }
  raw.head_angles.clear();
  for (const std::int16_t angle : report.head_angles) raw.head_angles.push_back(kAngleUnit * angle);
}

std::size_t saturatedSamples(const triangulation::RawScan& raw) {
  return static_cast<std::size_t>(std::count_if(
      raw.currents.begin(), raw.currents.end(),
      [](const triangulation::Photocurrents& pair) { return std::isnan(pair.total()); }));
}

void fillReport(const triangulation::RawScan& raw, ScanReport& report) {
  report.status = 0;
  report.currents.clear();
  for (const triangulation::Photocurrents& pair : raw.currents) {
    report.currents.push_back({toCount(pair.first, report), toCount(pair.second, report)});
  }
  report.head_angles.clear();
  for (const double angle : raw.head_angles) report.head_angles.push_back(toAngleUnits(angle));
  if (!report.head_angles.empty() &&
      std::any_of(report.head_angles.begin(), report.head_angles.end(),
                  [&](std::int16_t angle) { return angle != report.head_angles.front(); })) {
    report.status |= ScanReport::kHeadMoves;
  }
}

}  // namespace sightline::driver
