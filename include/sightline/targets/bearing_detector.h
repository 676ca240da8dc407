#pragma once

#include <vector>

#include "sightline/scan/scan.h"
#include "sightline/targets/bearing_set.h"

namespace sightline::targets {

/// Settings of BearingDetector.
struct BearingDetectorConfig {
  double threshold = 11000.0;      ///< least intensity of a target's return, the sensor's own unit
  double cluster_diameter = 0.12;  ///< largest distance of two returns of one target [m]
  double range_min = 0.0;          ///< [m]
  double range_max = 5.0;          ///< [m]
  FieldOfView field_of_view;       ///< bearings beyond it are left out
  double sigma = 0.0;  ///< standard deviation of a bearing; 0: by the beams' spacing [rad]

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where a value is out of range or two do not fit.
  void check(const std::string& source = "") const;
};

/// Makes a laser scanner a bearing-only sensor (dames section 2): keeps the returns of high
/// intensity, gathers them in clusters by range and bearing, and forgets the ranges.
class BearingDetector {
 public:
  /// Throws config::Error as BearingDetectorConfig::check.
  explicit BearingDetector(const BearingDetectorConfig& config = {});

  /// One bearing a cluster [rad], in the sensor's frame at the scan's stamp: the motion within the
  /// sweep is taken out where the scan knows it. The field of view is that of scanner and settings
  /// together; a set without bearings is one, too. Throws scan::InvalidScan where the scan has no
  /// intensities, or sees nothing of the field of view.
  BearingSet detect(const scan::Scan& scan) const;
  /// Bearings that the scanner sees and the settings allow; a view across the seam behind the
  /// sensor ends there.
  FieldOfView viewOf(const scan::ScanGeometry& geometry) const;

 private:
  std::vector<std::size_t> brightBeams(const scan::Scan& scan) const;

  BearingDetectorConfig config_;
};

}  // namespace sightline::targets
