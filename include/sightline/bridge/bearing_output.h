#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <sightline/BearingArray.h>
#include "sightline/bridge/output.h"
#include "sightline/pipeline/located_scan.h"
#include "sightline/targets/bearing_detector.h"

namespace sightline::bridge {

/// Runs the bearing detector on scans and writes what it finds, in the frame of the scan:
/// `bearings`, a message for each scan whether anything was seen or not, and `bearing_markers`.
class BearingOutput {
 public:
  /// Throws config::Error.
  BearingOutput(Output& output, const targets::BearingDetectorConfig& config);

  /// Throws scan::InvalidScan as the detector does.
  void write(const pipeline::LocatedScan& located);

  std::size_t scans() const { return scans_; }
  std::size_t bearings() const { return bearings_; }
  /// Scans without a bearing.
  std::size_t emptySets() const { return empty_; }

 private:
  targets::BearingDetector detector_;
  double range_min_;
  Port<BearingArray> sets_;
  Port<visualization_msgs::MarkerArray> markers_;
  std::size_t scans_ = 0;
  std::size_t bearings_ = 0;
  std::size_t empty_ = 0;
};

/// Rays along the bearings, as long as the sensor's range.
visualization_msgs::MarkerArray toMarkers(const BearingArray& message);

}  // namespace sightline::bridge
