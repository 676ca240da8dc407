#pragma once

#include <sensor_msgs/LaserScan.h>

#include <sightline/RangeScan.h>
#include "sightline/bridge/scan_conversion.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::bridge {

RangeScan toMessage(const motion::RangeScan& range_scan);

/// The same beams for a consumer that knows no other message: intensities are the currents in nA.
/// The frame is that of the first beam, and no beam tells how the head went on turning; a consumer
/// that needs it takes it from tf, beam by beam with time_increment.
sensor_msgs::LaserScan toLaserScan(const RangeScan& message);

/// Range scans from messages.
class RangeScanReader {
 public:
  /// Throws scan::InvalidScan with the reason: whatever ScanReader finds, a number of variances,
  /// currents or head angles that is not that of the ranges, a variance of a valid range that is
  /// not positive and finite, an origin or a head angle that is not finite.
  motion::RangeScan read(const RangeScan& message);

 private:
  ScanReader reader_;
};

}  // namespace sightline::bridge
