#include "sightline/geometry/angle.h"
#include "sightline/geometry/arc.h"
#include "sightline/geometry/line_segment.h"

namespace sightline::geometry {

LineSegment mirrored(const LineSegment& segment) {
  LineSegment result = segment;
  result.line.phi = wrapAngle(-segment.line.phi);
  result.line.covariance(0, 1) *= -1.0;
  result.line.covariance(1, 0) *= -1.0;
  result.ends.start.y() *= -1.0;
  result.ends.end.y() *= -1.0;
  return result;
}

Arc mirrored(const Arc& arc) {
  const Eigen::Vector3d sense(1.0, -1.0, 1.0);
  Arc result = arc;
  result.centre.y() *= -1.0;
  result.covariance = sense.asDiagonal() * arc.covariance * sense.asDiagonal();
  // Counter-clockwise from start to end: what was the end comes first.
  result.start_angle = wrapAngle(-arc.end_angle);
  result.end_angle = result.start_angle + (arc.end_angle - arc.start_angle);
  return result;
}

}  // namespace sightline::geometry
