#pragma once

#include <cstddef>
#include <cstdint>

#include "sightline/geometry/polar_line.h"
#include "sightline/geometry/segment.h"

namespace sightline::geometry {

/// Reason for the end of a segment; values as in LineSegment.msg.
enum class EndKind : std::uint8_t {
  kUnknown = 0,
  kCorner = 1,         ///< two walls meet
  kOccludingEdge = 2,  ///< the wall really ends
  kOccluded = 3,       ///< something nearer hides the rest
  kScanLimit = 4,      ///< the scan or the sensor's range ends
};

/// A straight piece of a scan, in the scan's frame at its stamp: the line with its covariance, and
/// where it ends.
struct LineSegment {
  std::uint32_t id = 0;  ///< lasts over scans once features are tracked; 0 before
  PolarLine line;
  Segment ends;              ///< on the line; start met by the first beam
  double start_sigma = 0.0;  ///< standard deviation of the start along the line [m]
  double end_sigma = 0.0;    ///< standard deviation of the end along the line [m]
  EndKind start_kind = EndKind::kUnknown;
  EndKind end_kind = EndKind::kUnknown;
  std::size_t first_beam = 0;
  std::size_t last_beam =
      0;  ///< smaller than first_beam where the segment crosses the seam of a full circle
  std::size_t beams = 0;    ///< beams the line was fitted to
  double chi_square = 0.0;  ///< sum of their squared normalised residuals
  std::size_t degrees_of_freedom = 0;
};

/// The segment as the same sensor the right way up sees it, of one that hangs upside down: mirrored
/// at the x axis (φ → −φ, y → −y). Beams keep their numbers, and so the start stays the end that
/// the first beam met; the covariance of ρ and φ changes its sign.
LineSegment mirrored(const LineSegment& segment);

}  // namespace sightline::geometry
