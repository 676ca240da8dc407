#include "sightline/geometry/line_segment.h"

namespace sightline::geometry {

LineSegment mirrored(const LineSegment& segment) {
  LineSegment result = segment;
  result.line.phi = wrapAngle(-segment.line.phi);
  result.line.covariance(0, 1) = -segment.line.covariance(0, 1);
  result.line.covariance(1, 0) = -segment.line.covariance(1, 0);
  result.ends.start.y() = -segment.ends.start.y();
  result.ends.end.y() = -segment.ends.end.y();
  return result;
}

}  // namespace sightline::geometry
