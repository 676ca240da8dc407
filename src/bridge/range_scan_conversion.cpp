#include "sightline/bridge/range_scan_conversion.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace sightline::bridge {

namespace {

void requireLength(const char* what, std::size_t length, std::size_t beams) {
  if (length == beams) return;
  throw scan::InvalidScan(fmt::format("{} {} for {} ranges", length, what, beams));
}

void checkLengths(const RangeScan& message) {
  const std::size_t beams = message.ranges.size();
  requireLength("variances", message.variances.size(), beams);
  requireLength("currents", message.currents.size(), beams);
  requireLength("head angles", message.head_angles.size(), beams);
}

void checkHead(const RangeScan& message) {
  if (!std::isfinite(message.origin_x) || !std::isfinite(message.origin_y)) {
    throw scan::InvalidScan("an origin that is not finite");
  }
  const auto is_finite = [](double angle) { return std::isfinite(angle); };
  if (!std::all_of(message.head_angles.begin(), message.head_angles.end(), is_finite)) {
    throw scan::InvalidScan("a head angle that is not finite");
  }
}

void takeVariances(const RangeScan& message, scan::Scan& scan) {
  scan.setRangeVariances(message.variances);
  for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
    const double variance = scan.rangeVariances()[beam];
    if (scan.isValid(beam) && !(variance > 0.0 && std::isfinite(variance))) {
      throw scan::InvalidScan(fmt::format("a variance of {} m^2 at beam {}", variance, beam));
    }
  }
}

}  // namespace

RangeScan toMessage(const motion::RangeScan& range_scan) {
  const sensor_msgs::LaserScan scan = toMessage(range_scan.scan);
  RangeScan message;
  message.header = scan.header;
  message.angle_min = scan.angle_min;
  message.angle_max = scan.angle_max;
  message.angle_increment = scan.angle_increment;
  message.time_increment = scan.time_increment;
  message.scan_time = scan.time_increment * static_cast<float>(scan.ranges.size());
  message.range_min = scan.range_min;
  message.range_max = scan.range_max;
  message.ranges = scan.ranges;
  message.variances = range_scan.scan.rangeVariances();
  message.currents = scan.intensities;
  message.head_angles = range_scan.head.angles;
  message.mount_frame = range_scan.head.mount_frame;
  message.origin_x = range_scan.head.origin.x();
  message.origin_y = range_scan.head.origin.y();
  return message;
}

sensor_msgs::LaserScan toLaserScan(const RangeScan& message) {
  constexpr float kNanoamperes = 1e9F;  // in an ampere
  sensor_msgs::LaserScan scan = withoutRanges(message);
  scan.ranges = message.ranges;
  for (const float current : message.currents) scan.intensities.push_back(kNanoamperes * current);
  return scan;
}

motion::RangeScan RangeScanReader::read(const RangeScan& message) {
  checkLengths(message);
  checkHead(message);
  motion::RangeScan result;
  result.scan = reader_.read(toLaserScan(message));
  result.scan.setIntensities({message.currents.begin(), message.currents.end()});
  takeVariances(message, result.scan);
  result.head.angles = message.head_angles;
  result.head.mount_frame = message.mount_frame;
  result.head.origin = {message.origin_x, message.origin_y};
  result.scan.setSensorMotion(motion::headMotion(result.head));
  return result;
}

}  // namespace sightline::bridge
