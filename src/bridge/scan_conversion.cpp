#include "sightline/bridge/scan_conversion.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

constexpr double kLongestSweep = 60.0;  // [s]

void checkMessage(const sensor_msgs::LaserScan& message) {
  if (message.header.stamp.isZero()) throw scan::InvalidScan("a stamp of zero");
  const double sweep =
      static_cast<double>(message.time_increment) * static_cast<double>(message.ranges.size());
  if (std::abs(sweep) > kLongestSweep) {
    throw scan::InvalidScan(fmt::format("a sweep of {:.4g} s", sweep));
  }
  if (!message.intensities.empty() && message.intensities.size() != message.ranges.size()) {
    throw scan::InvalidScan(fmt::format("{} intensities for {} ranges", message.intensities.size(),
                                        message.ranges.size()));
  }
}

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

}  // namespace

bool ScanReader::hasGeometryOf(const sensor_msgs::LaserScan& message) const {
  return geometry_ && built_beams_ == message.ranges.size() &&
         built_from_.angle_min == message.angle_min &&
         built_from_.angle_increment == message.angle_increment &&
         built_from_.range_min == message.range_min && built_from_.range_max == message.range_max;
}

void ScanReader::takeTimes(const sensor_msgs::LaserScan& message) {
  if (built_from_.time_increment == message.time_increment) return;
  geometry_ = geometry_->withTimeIncrement(message.time_increment);
  built_from_.time_increment = message.time_increment;
}

void ScanReader::rebuildGeometry(const sensor_msgs::LaserScan& message) {
  geometry_ =
      scan::ScanGeometry::uniform(message.angle_min, message.angle_increment, message.ranges.size(),
                                  message.time_increment, message.range_min, message.range_max);
  built_from_ = message;
  built_from_.ranges.clear();
  built_from_.intensities.clear();
  built_beams_ = message.ranges.size();
}

scan::Scan ScanReader::read(const sensor_msgs::LaserScan& message) {
  checkMessage(message);
  if (!hasGeometryOf(message)) rebuildGeometry(message);
  takeTimes(message);
  scan::Scan scan(geometry_, nanoseconds(message.header.stamp),
                  {message.ranges.begin(), message.ranges.end()},
                  {message.intensities.begin(), message.intensities.end()});
  scan.frame = message.header.frame_id;
  return scan;
}

sensor_msgs::LaserScan toMessage(const scan::Scan& scan) {
  const scan::ScanGeometry& geometry = *scan.geometry();
  sensor_msgs::LaserScan message;
  message.header.stamp = timeOf(scan.stamp);
  message.header.frame_id = scan.frame;
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
