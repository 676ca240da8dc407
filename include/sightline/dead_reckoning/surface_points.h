#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::dead_reckoning {

/// Return of a beam, and the surface there as its neighbours show it.
struct SurfacePoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m], in the base at the scan's stamp
  /// Unit normal towards the sensor; zero where the surface is not known.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  Eigen::Vector2d smoothed = Eigen::Vector2d::Zero();  ///< position, moved onto that surface
  double normal_variance = 0.0;                        ///< of the normal's direction [rad²]
  double reach = 0.0;     ///< how far the surface goes on to either side before the next beam [m]
  double variance = 0.0;  ///< of the position across the surface [m²]

  bool hasNormal() const { return normal != Eigen::Vector2d::Zero(); }
};

/// Time and place from which a point was seen.
struct Sighting {
  double time = 0.0;  ///< since the first beam, as a share of the sweep's, [0, 1]
  Eigen::Vector2d sensor_base = Eigen::Vector2d::Zero();  ///< of the sensor then [m]
};

/// Surfaces around, as one scan shows them.
struct SurfaceScan {
  std::size_t scanner = 0;                           ///< that took it
  std::vector<SurfacePoint> points;                  ///< of the valid beams, in their order
  Eigen::Vector2d sensor = Eigen::Vector2d::Zero();  ///< in the base, at the stamp [m]
  double beam_angle = 0.0;                           ///< from one beam to the next [rad]
  double sigma = 0.0;                                ///< median standard deviation along a beam [m]
  /// Noise of the sensor's motion, along the axes of the base. The jitter is in the variances of
  /// the points.
  scan::MotionNoise motion_noise;
  /// One entry a point; empty where drift and walk of the motion are zero.
  std::vector<Sighting> sightings;
};

/// Reads the valid beams of a scan. Each point gets a line through its neighbours on the same
/// surface: those on both sides, or on the better one, so that corners stay sharp. A far point
/// whose neighbours show none is taken for a thing as wide as the beam that faces the sensor: a
/// door frame down a corridor is a return or two. Lengths grow with the noise of the beams.
///
/// @param twist  of the base [m/s, m/s, rad/s]: corrects the sweep where the beams have time
///               offsets and the scan says no motion of its own
SurfaceScan readSurfaces(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                         const Eigen::Vector3d& twist);

}  // namespace sightline::dead_reckoning
