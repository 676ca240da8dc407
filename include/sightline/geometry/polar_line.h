#pragma once

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"

namespace sightline::geometry {

/// The line { p : n·p = ρ } with n = (cos φ, sin φ), pointing from the origin to the line, and the
/// covariance of (ρ, φ).
///
/// ρ ≥ 0 [m], φ in (−π, π] [rad]; covariance [m², m rad; m rad, rad²]. A line through the origin
/// has two descriptions, (0, φ) and (0, φ + π); both are accepted.
struct PolarLine {
  double rho = 0.0;
  double phi = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  Eigen::Vector2d normal() const { return {std::cos(phi), std::sin(phi)}; }
  /// Unit vector along the line, 90° counter-clockwise from the normal.
  Eigen::Vector2d direction() const { return {-std::sin(phi), std::cos(phi)}; }
  /// Positive on the side that does not hold the origin.
  double signedDistance(const Eigen::Vector2d& point) const { return normal().dot(point) - rho; }
  Eigen::Vector2d project(const Eigen::Vector2d& point) const {
    return point - signedDistance(point) * normal();
  }
};

/// The same line with ρ ≥ 0 and φ wrapped.
PolarLine canonical(const PolarLine& line);

/// The line in another frame, its covariance taken along (pears eqs 15 and 25 are the case of a
/// pure rotation about a point). Exact in value, first order in covariance.
PolarLine transform(const Pose2& T_target_source, const PolarLine& line_source);

/// The same where the transform is uncertain too, independently of the line.
PolarLine transform(const UncertainPose2& T_target_source, const PolarLine& line_source);

/// ∂(ρ, φ)target / ∂(ρ, φ)source of `transform`.
Eigen::Matrix2d transformJacobianLine(const Pose2& T_target_source, const PolarLine& line_source);
/// ∂(ρ, φ)target / ∂(x, y, θ) of `transform`.
Eigen::Matrix<double, 2, 3> transformJacobianPose(const Pose2& T_target_source,
                                                  const PolarLine& line_source);

/// The line described with the normal that lies within 90° of the reference's; ρ may become
/// negative.
PolarLine describedLike(const PolarLine& reference, const PolarLine& line);

/// Difference a − b of two descriptions of nearly the same line, as (Δρ, Δφ), over the seam of φ
/// and over ρ = 0.
Eigen::Vector2d difference(const PolarLine& a, const PolarLine& b);

}  // namespace sightline::geometry
