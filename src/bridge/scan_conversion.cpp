#include "sightline/bridge/scan_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/angle.h"

namespace sightline::bridge {

namespace {

// Longest time that a mirror takes for a turn [s].
constexpr double kLongestSweep = 5.0;
// No planar scanner sees so far [m].
constexpr double kFarthest = 1000.0;
// A turn, and what the floats of a message may overshoot by [rad].
constexpr double kLargestSpan = 2.0 * geometry::kPi + 1e-3;

float rangeOf(const scan::Scan& scan, std::size_t beam) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  switch (scan.kinds()[beam]) {
    case scan::ReturnKind::kTooNear:
      return -kInfinity;
    case scan::ReturnKind::kNothing:
      return kInfinity;
    case scan::ReturnKind::kInvalid:
      return std::numeric_limits<float>::quiet_NaN();
    case scan::ReturnKind::kValid:
      break;
  }
  return static_cast<float>(scan.ranges()[beam]);
}

bool isSame(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace

bool ScanReader::hasGeometryOf(const sensor_msgs::LaserScan& message) const {
  return geometry_ && built_beams_ == message.ranges.size() &&
         isSame(built_from_.angle_min, message.angle_min) &&
         isSame(built_from_.angle_max, message.angle_max) &&
         isSame(built_from_.angle_increment, message.angle_increment) &&
         isSame(built_from_.range_min, message.range_min) &&
         isSame(built_from_.range_max, message.range_max);
}

void ScanReader::takeTimes(const sensor_msgs::LaserScan& message) {
  if (isSame(built_from_.time_increment, message.time_increment)) return;
  geometry_ = geometry_->withTimeIncrement(timeIncrementOf(message));
  built_from_.time_increment = message.time_increment;
}

void ScanReader::rebuildGeometry(const sensor_msgs::LaserScan& message) {
  const config::Range limits = limitsOf(message);
  geometry_ = scan::ScanGeometry::uniform(message.angle_min, angleIncrementOf(message),
                                          message.ranges.size(), timeIncrementOf(message),
                                          limits.min, limits.max);
  built_from_ = message;
  built_from_.ranges.clear();
  built_from_.intensities.clear();
  built_beams_ = message.ranges.size();
}

// An increment of zero, of degrees or of nothing is replaced by what the first and the last angle
// say, where these can be true.
double ScanReader::angleIncrementOf(const sensor_msgs::LaserScan& message) {
  const double increment = message.angle_increment;
  const double steps = static_cast<double>(message.ranges.size()) - 1.0;
  const double span = static_cast<double>(message.angle_max) - message.angle_min;
  const auto isSpan = [](double angle) {
    return std::abs(angle) > 0.0 && std::abs(angle) < kLargestSpan;
  };
  if (steps < 1.0 || isSpan(steps * increment) || !isSpan(span)) return increment;
  mended_.try_emplace("angle_increment",
                      fmt::format("an angle increment of {}: taken for {:.4g}, by angle_min and "
                                  "angle_max",
                                  increment, span / steps));
  return span / steps;
}

config::Range ScanReader::limitsOf(const sensor_msgs::LaserScan& message) {
  const double nearest = message.range_min;
  const double farthest = std::min<double>(message.range_max, kFarthest);
  if (nearest >= 0.0 && nearest < farthest) return {nearest, farthest};
  mended_.try_emplace("range limits", fmt::format("range limits {} to {} m: taken for none",
                                                  message.range_min, message.range_max));
  return {0.0, kFarthest};
}

double ScanReader::timeIncrementOf(const sensor_msgs::LaserScan& message) {
  const double increment = message.time_increment;
  const double sweep = increment * static_cast<double>(message.ranges.size());
  if (std::abs(sweep) < kLongestSweep) return increment;
  mended_.try_emplace(
      "time_increment",
      fmt::format("time_increment {:.6g} would be a sweep of {:.4g} s: taken for one of unknown "
                  "duration",
                  increment, sweep));
  return 0.0;
}

std::vector<double> ScanReader::intensitiesOf(const sensor_msgs::LaserScan& message) {
  const std::size_t count = message.intensities.size();
  if (count == message.ranges.size()) {
    return {message.intensities.begin(), message.intensities.end()};
  }
  if (count > 0) {
    mended_.try_emplace("intensities", fmt::format("{} intensities for {} ranges: taken for none",
                                                   count, message.ranges.size()));
  }
  return {};
}

scan::Scan ScanReader::read(const sensor_msgs::LaserScan& message) {
  if (!hasGeometryOf(message)) rebuildGeometry(message);
  takeTimes(message);
  scan::Scan scan(geometry_, nanoseconds(message.header.stamp),
                  {message.ranges.begin(), message.ranges.end()}, intensitiesOf(message));
  scan.frame = withoutSlash(message.header.frame_id);
  return scan;
}

sensor_msgs::LaserScan firstEchoes(const sensor_msgs::MultiEchoLaserScan& message) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  const auto first = [](const sensor_msgs::LaserEcho& echo, float none) {
    return echo.echoes.empty() ? none : echo.echoes.front();
  };
  sensor_msgs::LaserScan scan = withoutRanges(message);
  for (const auto& echo : message.ranges) scan.ranges.push_back(first(echo, kNothing));
  for (const auto& echo : message.intensities) scan.intensities.push_back(first(echo, 0.0F));
  return scan;
}

sensor_msgs::LaserScan toMessage(const scan::Scan& scan) {
  const scan::ScanGeometry& geometry = *scan.geometry();
  sensor_msgs::LaserScan message;
  message.header = headerOf(scan.stamp, scan.frame);
  message.angle_min = static_cast<float>(geometry.angles().front());
  message.angle_max = static_cast<float>(geometry.angles().back());
  message.angle_increment = static_cast<float>(geometry.angleIncrement());
  message.range_min = static_cast<float>(geometry.rangeMin());
  message.range_max = static_cast<float>(geometry.rangeMax());
  if (geometry.beams() > 1) {
    message.time_increment = static_cast<float>(geometry.timeOffsets().back() /
                                                static_cast<double>(geometry.beams() - 1));
  }
  message.ranges.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) message.ranges.push_back(rangeOf(scan, i));
  message.intensities.assign(scan.intensities().begin(), scan.intensities().end());
  return message;
}

}  // namespace sightline::bridge
