#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::tracking {

/// A valid beam as the tracker sees it, in the base frame at the stamp of the scan.
struct BeamPoint {
  std::size_t beam = 0;
  Eigen::Vector2d position;    ///< where it ended [m]
  Eigen::Vector2d origin;      ///< where the sensor was [m]
  double range = 0.0;          ///< [m]
  Eigen::Matrix2d covariance;  ///< of the position [m²]
};

/// The valid beams of a scan. `point_sigma` above zero replaces the scan's noise by an isotropic one (jensfelt section 2).
std::vector<BeamPoint> beamPoints(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                                  double point_sigma = 0.0);

}  // namespace sightline::tracking
