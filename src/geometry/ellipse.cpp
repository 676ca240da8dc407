#include "sightline/geometry/ellipse.h"

#include <algorithm>
#include <cmath>

namespace sightline::geometry {

Ellipse covarianceEllipse(const Eigen::Matrix2d& covariance, double scale) {
  // Eigenvalues of a symmetric 2x2 matrix in closed form.
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half_difference = 0.5 * (covariance(0, 0) - covariance(1, 1));
  const double half_eigenvalue_difference = std::hypot(half_difference, covariance(0, 1));
  return {scale * std::sqrt(std::max(0.0, mean + half_eigenvalue_difference)),
          scale * std::sqrt(std::max(0.0, mean - half_eigenvalue_difference)),
          0.5 * std::atan2(covariance(0, 1), half_difference)};
}

}  // namespace sightline::geometry
