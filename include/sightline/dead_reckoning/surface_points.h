#pragma once

#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::dead_reckoning {

/// Where a beam ended, and the surface there as its neighbours show it.
struct SurfacePoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m], in the base at the scan's stamp
  /// Unit normal towards the sensor; zero where the neighbours show no straight surface.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  Eigen::Vector2d smoothed = Eigen::Vector2d::Zero();  ///< position, moved onto that surface
  double reach = 0.0;     ///< how far the surface goes on to either side before the next beam [m]
  double variance = 0.0;  ///< of the position across the surface [m²]

  bool hasNormal() const { return normal != Eigen::Vector2d::Zero(); }
};

/// The valid beams of a scan in the base's frame at its stamp.
///
/// @param twist  of the base [m/s, m/s, rad/s]: corrects the sweep where the beams have time
///               offsets and the scan says no motion of its own
void positionsOf(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                 const Eigen::Vector3d& twist, std::vector<SurfacePoint>& points);

/// Fits a line to the neighbours of each point that lie on one surface with it: to both sides, or
/// to the better one, so that corners stay sharp. `points` are in the order of the beams.
void findSurfaces(const Eigen::Vector2d& sensor_base, double beam_angle,
                  std::vector<SurfacePoint>& points);

}  // namespace sightline::dead_reckoning
