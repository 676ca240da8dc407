#include "sightline/dead_reckoning/unbound_axis.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace sightline::dead_reckoning {

namespace {

constexpr struct {
  // Variance that a pose may have along a wall without its direction mattering [m²].
  double little = 0.0025;
  // Errors of the directions of walls stay below this [rad].
  double direction = 0.03;
  // Standard deviations above which a step is loose [m, rad]: one off by 20 cm or 5 degrees is
  // likely.
  double loose_position = 0.1;
  double loose_heading = 0.0436;
} kUnbound;

using Axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>;

Axes axesOf(const Eigen::Matrix2d& matrix) {
  Axes axes;
  axes.computeDirect(matrix);
  return axes;
}

// Information on the position, whatever the heading is.
Eigen::Matrix2d ofPosition(const Eigen::Matrix3d& information) {
  const Eigen::Vector2d with_heading = information.topRightCorner<2, 1>();
  const double heading = information(2, 2);
  if (heading <= 0.0) return information.topLeftCorner<2, 2>();
  return information.topLeftCorner<2, 2>() - with_heading * with_heading.transpose() / heading;
}

}  // namespace

Eigen::Matrix3d turnedToUnbound(const Eigen::Matrix3d& covariance,
                                const Eigen::Matrix3d& information) {
  if (covariance.topLeftCorner<2, 2>().trace() < kUnbound.little) return covariance;
  const Axes prior = axesOf(covariance.topLeftCorner<2, 2>());
  const Axes match = axesOf(ofPosition(information));
  if (match.eigenvalues()[0] * prior.eigenvalues()[1] > 1.0) return covariance;
  const Eigen::Vector2d longest = prior.eigenvectors().col(1);
  const Eigen::Vector2d unbound = match.eigenvectors().col(0);
  const double sine = longest.x() * unbound.y() - longest.y() * unbound.x();
  if (std::abs(sine) > kUnbound.direction) return covariance;
  const double turn = longest.dot(unbound) > 0.0 ? std::asin(sine) : -std::asin(sine);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(turn).toRotationMatrix();
  return axes * covariance * axes.transpose();
}

bool isLoose(const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  const double half = 0.5 * position.trace();
  const double largest = half + std::sqrt(std::max(0.0, half * half - position.determinant()));
  return largest > kUnbound.loose_position * kUnbound.loose_position ||
         covariance(2, 2) > kUnbound.loose_heading * kUnbound.loose_heading;
}

}  // namespace sightline::dead_reckoning
