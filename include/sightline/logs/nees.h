#pragma once

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"

namespace sightline::logs {

/// Normalised estimation error squared, eᵀ P⁻¹ e: of an estimate whose covariance P is right, the
/// mean over many is the number of dimensions. Throws std::invalid_argument where P is not positive
/// definite.
double nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance);

/// NEES of a pose, in (x, y, θ) with the heading's error wrapped: ideal mean 3.
double nees(const geometry::UncertainPose2& estimate, const geometry::Pose2& truth);

}  // namespace sightline::logs
