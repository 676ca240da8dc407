#pragma once

#include <memory>

#include <sensor_msgs/LaserScan.h>

#include "sightline/scan/scan.h"

namespace sightline::bridge {

/// Scans from messages, with the variance that scan::Scan starts from. Keeps the geometry of the
/// last message, so that the trigonometry of a sensor is done once.
class ScanReader {
 public:
  /// Throws scan::InvalidScan with the reason: no beams, a sweep of more than a minute, an
  /// increment of zero or NaN, limits out of order, a time stamp of zero, a number of intensities
  /// that is neither zero nor that of the ranges.
  scan::Scan read(const sensor_msgs::LaserScan& message);

 private:
  bool hasGeometryOf(const sensor_msgs::LaserScan& message) const;
  // Many drivers measure the time increment anew for each scan.
  void takeTimes(const sensor_msgs::LaserScan& message);
  void rebuildGeometry(const sensor_msgs::LaserScan& message);

  sensor_msgs::LaserScan built_from_;  // its ranges are dropped
  std::size_t built_beams_ = 0;
  std::shared_ptr<const scan::ScanGeometry> geometry_;
};

/// NaN, ±Inf and zeros come back as REP-117 asks; intensities only if the scan has them.
sensor_msgs::LaserScan toMessage(const scan::Scan& scan);

}  // namespace sightline::bridge
