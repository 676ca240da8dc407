#include "sightline/tracking/wall_error.h"

#include "sightline/geometry/polar_line.h"

namespace sightline::tracking {

WallError::WallError(const world::WallIndex& index, const geometry::Segment& segment_map,
                     const WallConfig& config)
    : wall(index) {
  const geometry::PolarLine line = segment_map.line();
  const double sense = line.normal().dot(segment_map.leftNormal()) >= 0.0 ? 1.0 : -1.0;
  line_jacobian << sense, line.direction().dot(segment_map.midpoint()), 0.0, 1.0;
  covariance = Eigen::Vector2d(config.position_sigma * config.position_sigma,
                               config.direction_sigma * config.direction_sigma)
                   .asDiagonal();
}

}  // namespace sightline::tracking
