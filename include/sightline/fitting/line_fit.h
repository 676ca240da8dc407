#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/polar_line.h"

namespace sightline::fitting {

/// A line through points, with the covariance that the points' own covariances imply.
struct LineFit {
  geometry::PolarLine line;
  double chi_square = 0.0;  ///< sum of squared normalised residuals
  std::size_t degrees_of_freedom = 0;
};

/// A measured point and the covariance of its error [m²].
struct NoisyPoint {
  Eigen::Vector2d position;
  Eigen::Matrix2d covariance;
};

/// Batch start of pears section 4.6: the points are turned by the bearing of their weighted
/// centroid, where the noise of a range sensor lies along the axis, and fitted there by weighted
/// linear least squares (eq. 38). Nothing where fewer than two points, or points in one place,
/// leave the line undetermined.
std::optional<geometry::PolarLine> startLine(const std::vector<NoisyPoint>& points);

/// Maximum-likelihood line: damped Gauss-Newton on Σ (n·p − ρ)² / (nᵀ C n), which for noise along
/// the beams is pears eq. 37 with each residual divided by its σ_r. The covariance is the inverse
/// information (pears eq. 39). The minimum is the one that lies downhill of the start: where the
/// noise lies along the beams, a start beyond the orientation of one of them leads elsewhere.
/// Nothing where the points do not determine a line or the iteration does not settle.
std::optional<LineFit> refineLine(const std::vector<NoisyPoint>& points,
                                  const geometry::PolarLine& start);

/// Start and refinement in one.
std::optional<LineFit> fitLine(const std::vector<NoisyPoint>& points);

}  // namespace sightline::fitting
