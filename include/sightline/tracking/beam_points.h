#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/tracking/sweep_error.h"

namespace sightline::tracking {

/// A valid beam as the tracker sees it, in the base frame at the stamp of the scan.
struct BeamPoint {
  std::size_t beam = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    ///< where it ended [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();      ///< where the sensor was [m]
  double range = 0.0;                                    ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the position [m²]
  double sweep_ratio = 0.0;  ///< time since the first beam over that of the last, [0, 1]
};

/// Ranges that a sensor can tell [m].
struct Reach {
  double range_min = 0.0;
  double range_max = std::numeric_limits<double>::infinity();
};

/// Ends of beams, coordinate by coordinate, for what looks at all of them.
struct BeamEnds {
  std::vector<double> x, y;  ///< in the base frame [m]

  explicit BeamEnds(const std::vector<BeamPoint>& points);
};

/// The valid beams of a scan, and what is not known of the motion from the first beam to the last.
struct Sweep {
  std::vector<BeamPoint> points;
  Reach reach;
  SweepNoise motion_noise;  ///< zero where the motion is known
};

/// Reads a scan. Its motion noise is taken for the base's: turned into a twist of the sensor's
/// frame at the stamp it changes to the base frame by the adjoint, whatever a head did in between.
/// `jitter` widens each beam across its distance from the axis.
///
/// @param T_base_sensor  at the stamp of the scan
Sweep readSweep(const scan::Scan& scan, const geometry::Pose2& T_base_sensor);

/// Gives every beam the same noise in x and in y [m] (jensfelt section 2), the motion being known.
void makeIsotropic(Sweep& sweep, double sigma);

}  // namespace sightline::tracking
