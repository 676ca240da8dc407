#include "sightline/tracking/reach.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sightline::tracking {

namespace {

bool isWithin(const BeamPoint& point, const geometry::PolarLine& line, const Reach& reach,
              double sigmas) {
  const Eigen::Vector2d direction = (point.position - point.origin) / point.range;
  const Eigen::Vector2d normal = line.normal();
  const double range = (line.rho - normal.dot(point.origin)) / normal.dot(direction);
  const double spread = sigmas * std::sqrt(direction.dot(point.covariance * direction));
  return range - spread > reach.range_min && range + spread < reach.range_max;
}

}  // namespace

std::vector<const BeamPoint*> withinReach(const std::vector<const BeamPoint*>& points,
                                          const geometry::PolarLine& line, const Reach& reach,
                                          double sigmas) {
  std::vector<const BeamPoint*> within;
  within.reserve(points.size());
  std::copy_if(points.begin(), points.end(), std::back_inserter(within),
               [&](const BeamPoint* point) { return isWithin(*point, line, reach, sigmas); });
  return within;
}

}  // namespace sightline::tracking
