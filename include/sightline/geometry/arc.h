#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace sightline::geometry {

/// A round piece of a scan (a pillar, a leg, a curved wall), in the scan's frame at its stamp: the
/// circle with its covariance, and how much of it is seen.
struct Arc {
  std::uint32_t id = 0;  ///< lasts over scans once features are tracked; 0 before
  Eigen::Vector2d centre{0, 0};
  double radius = 0.0;                                   ///< [m], positive
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< order x, y, radius [m²]
  /// Directions from the centre between which it is seen, counter-clockwise from start to end:
  /// start in (−π, π], end in [start, start + 2π) [rad].
  double start_angle = 0.0;
  double end_angle = 0.0;
  std::size_t first_beam = 0;
  std::size_t last_beam = 0;  ///< smaller than first_beam where the arc crosses the seam
  std::size_t beams = 0;      ///< beams the arc was fitted to
  double chi_square = 0.0;    ///< sum of their squared normalised residuals
  std::size_t degrees_of_freedom = 0;
};

/// The arc as the same sensor the right way up sees it, of one that hangs upside down: mirrored at
/// the x axis. Beams keep their numbers; as angles run counter-clockwise, start and end angle
/// change places.
Arc mirrored(const Arc& arc);

}  // namespace sightline::geometry
