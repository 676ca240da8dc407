#pragma once

#include <memory>

#include <sensor_msgs/LaserScan.h>

#include "sightline/scan/noise_model.h"
#include "sightline/scan/scan.h"

namespace sightline::bridge {

/// Scans from messages. Keeps the geometry of the last message, so that the trigonometry of a
/// sensor is done once.
class ScanReader {
 public:
  explicit ScanReader(const scan::NoiseModel& noise = {}) : noise_(noise) {}

  void setNoise(const scan::NoiseModel& noise) { noise_ = noise; }
  /// A sensor mounted on its head turns the other way: its angles are negated, so that the scan is
  /// one of an upright sensor at the same place. Where the mounting is known, see bridge::Mounting.
  void setUpsideDown(bool upside_down) { upside_down_ = upside_down; }

  /// Throws scan::InvalidScan with the reason: no beams, a sweep of more than a minute, an
  /// increment of zero or NaN, limits out of order, a time stamp of zero, a number of intensities
  /// that is neither zero nor that of the ranges.
  scan::Scan read(const sensor_msgs::LaserScan& message);

 private:
  bool hasGeometryOf(const sensor_msgs::LaserScan& message) const;
  void rebuildGeometry(const sensor_msgs::LaserScan& message);

  scan::NoiseModel noise_;
  bool upside_down_ = false;
  bool built_upside_down_ = false;
  sensor_msgs::LaserScan built_from_;  // its ranges are dropped
  std::size_t built_beams_ = 0;
  std::shared_ptr<const scan::ScanGeometry> geometry_;
};

/// NaN, ±Inf and zeros come back as REP-117 asks; intensities only if the scan has them.
sensor_msgs::LaserScan toMessage(const scan::Scan& scan);

}  // namespace sightline::bridge
