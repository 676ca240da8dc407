#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include "sightline/config/range.h"
#include "sightline/scan/scan.h"

namespace sightline::bridge {

/// Scans from messages, with the variance that scan::Scan starts from. Keeps the geometry of the
/// last message, so that the trigonometry of a sensor is done once. Fields that cannot be true are
/// done without where that is possible: the times of the beams where the sweep would last longer
/// than any, limits of the range that are out of order, intensities that are not one for each
/// range, and an angle increment that contradicts angle_min and angle_max.
class ScanReader {
 public:
  /// Throws scan::InvalidScan with the reason: no beams, angles that are no angles.
  scan::Scan read(const sensor_msgs::LaserScan& message);
  /// Faults for which something was left out, the first of each field.
  const std::map<std::string, std::string>& mended() const { return mended_; }

 private:
  bool hasGeometryOf(const sensor_msgs::LaserScan& message) const;
  // Many drivers measure the time increment anew for each scan.
  void takeTimes(const sensor_msgs::LaserScan& message);
  void rebuildGeometry(const sensor_msgs::LaserScan& message);
  double angleIncrementOf(const sensor_msgs::LaserScan& message);
  config::Range limitsOf(const sensor_msgs::LaserScan& message);
  double timeIncrementOf(const sensor_msgs::LaserScan& message);
  std::vector<double> intensitiesOf(const sensor_msgs::LaserScan& message);

  sensor_msgs::LaserScan built_from_;  // its ranges are dropped
  std::size_t built_beams_ = 0;
  std::shared_ptr<const scan::ScanGeometry> geometry_;
  std::map<std::string, std::string> mended_;  // by field
};

/// What another message of a sweep says of it as a LaserScan, but for the ranges.
template <class Message>
sensor_msgs::LaserScan withoutRanges(const Message& message) {
  sensor_msgs::LaserScan scan;
  scan.header = message.header;
  scan.angle_min = message.angle_min;
  scan.angle_max = message.angle_max;
  scan.angle_increment = message.angle_increment;
  scan.time_increment = message.time_increment;
  scan.scan_time = message.scan_time;
  scan.range_min = message.range_min;
  scan.range_max = message.range_max;
  return scan;
}

/// Scan of the first echo of each beam; a beam without one saw nothing.
sensor_msgs::LaserScan firstEchoes(const sensor_msgs::MultiEchoLaserScan& message);

/// NaN, ±Inf and zeros come back as REP-117 asks; intensities only if the scan has them.
sensor_msgs::LaserScan toMessage(const scan::Scan& scan);

}  // namespace sightline::bridge
