#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/line_segment.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// The line extractor of pears section 4 alone: one pass of the extended Kalman filter along the
/// beams, in the projection frame of each beam in turn, with a batch start wherever an observation
/// is not validated. It has the fragmentation that the paper shows in figure 5; LineExtractor has
/// not. For comparison.
///
/// Where the scan says so, the motion has noise: Q of eqs 23 and 24 enters each prediction (eq. 21)
/// as if the errors of all stretches of time were independent, which is true of the walk alone.
class PlainExtractor {
 public:
  /// Uses gate, min_beams and start_beams of the settings alone. Throws config::Error.
  explicit PlainExtractor(const LineExtractorConfig& config = {});

  /// Segments in the scan's frame at its stamp, in the order of their first beams; kinds of ends
  /// are not found; a wall ends anywhere between its outermost return and the beam past it, and
  /// their sigmas along the line say so. Valid until the next call.
  const std::vector<geometry::LineSegment>& extract(const scan::Scan& scan);

 private:
  // A line in the frame of the sensor at the beam `last`.
  struct Track {
    geometry::PolarLine line;
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t beams = 0;
    double chi_square = 0.0;
    // Covariance of the sensor's coordinates at `last`, and of the line's error with them: both are
    // needed to take the line to the stamp.
    Eigen::Matrix3d motion = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 2, 3> line_motion = Eigen::Matrix<double, 2, 3>::Zero();
  };
  void predict(const scan::Scan& scan, std::size_t beam, Track& track) const;
  bool start(const scan::Scan& scan, const std::vector<std::size_t>& beams, Track& track) const;
  bool update(const scan::Scan& scan, std::size_t beam, Track& track) const;
  geometry::PolarLine atStamp(const scan::Scan& scan, const Track& track) const;
  void report(const scan::Scan& scan, const Track& track);

  LineExtractorConfig config_;
  std::vector<geometry::LineSegment> segments_;
};

}  // namespace sightline::lines
