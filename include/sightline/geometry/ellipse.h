#pragma once

#include <Eigen/Core>

#include "sightline/geometry/statistics.h"

namespace sightline::geometry {

/// Half axes [m] and the direction of the longer one [rad] of the curve (p−μ)ᵀ C⁻¹ (p−μ) = scale².
struct Ellipse {
  double major = 0.0;
  double minor = 0.0;
  double angle = 0.0;
};

Ellipse covarianceEllipse(const Eigen::Matrix2d& covariance, double scale = kPlane95);

}  // namespace sightline::geometry
