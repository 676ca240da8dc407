#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/scan/scan.h"

namespace sightline::tracking {

/// A valid beam as the tracker sees it, in the base frame at the stamp of the scan.
struct BeamPoint {
  std::size_t beam = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    ///< where it ended [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();      ///< where the sensor was [m]
  double range = 0.0;                                    ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the position [m²]
  double sweep_share = 0.0;  ///< of the sweep's duration that had passed, [0, 1]
};

/// The valid beams of a scan, and what is not known of the sensor's motion from the first beam to
/// the last.
struct Sweep {
  std::vector<BeamPoint> points;
  /// Of the motion over the whole sweep, in coordinates [m², m rad, rad²]; zero where the sensor
  /// stood still.
  Eigen::Matrix3d motion_covariance = Eigen::Matrix3d::Zero();
};

/// `point_sigma` above zero replaces the scan's noise by an isotropic one (jensfelt section 2).
Sweep readSweep(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                const motion::OdometryNoise& odometry, double point_sigma = 0.0);

}  // namespace sightline::tracking
