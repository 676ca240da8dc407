#include "sightline/geometry/arc.h"

#include "sightline/geometry/angle.h"

namespace sightline::geometry {

Arc mirrored(const Arc& arc) {
  Arc result = arc;
  result.centre.y() = -arc.centre.y();
  result.covariance.row(1) = -result.covariance.row(1).eval();
  result.covariance.col(1) = -result.covariance.col(1).eval();
  result.start_angle = wrapAngle(-arc.end_angle);
  result.end_angle = result.start_angle + (arc.end_angle - arc.start_angle);
  return result;
}

}  // namespace sightline::geometry
