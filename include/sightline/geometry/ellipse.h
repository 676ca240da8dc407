#pragma once

#include <Eigen/Core>

namespace sightline::geometry {

/// Half axes [m] and the direction of the longer one [rad] of the curve (p−μ)ᵀ C⁻¹ (p−μ) = scale².
struct Ellipse {
  double major = 0.0;
  double minor = 0.0;
  double angle = 0.0;
};

/// 95 % of a Gaussian in the plane lie within this many standard deviations: sqrt of the χ²
/// quantile, 2 d.o.f.
constexpr double kScale95 = 2.4477468306808161;

Ellipse covarianceEllipse(const Eigen::Matrix2d& covariance, double scale = kScale95);

}  // namespace sightline::geometry
