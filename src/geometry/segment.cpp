#include "sightline/geometry/segment.h"

#include <algorithm>

namespace sightline::geometry {

Eigen::Vector2d Segment::leftNormal() const {
  const Eigen::Vector2d d = direction();
  return {-d.y(), d.x()};
}

PolarLine Segment::line() const {
  const Eigen::Vector2d normal = leftNormal();
  PolarLine line;
  line.rho = normal.dot(start);
  line.phi = std::atan2(normal.y(), normal.x());
  return canonical(line);
}

double Segment::distance(const Eigen::Vector2d& point) const {
  const double position = std::clamp(along(point), 0.0, length());
  return (start + position * direction() - point).norm();
}

}  // namespace sightline::geometry
