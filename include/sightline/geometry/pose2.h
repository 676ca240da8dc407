#pragma once

#include <Eigen/Core>

#include "sightline/geometry/angle.h"

namespace sightline::geometry {

/// A rigid motion of the plane, SE(2). `T_a_b` takes points of frame b to frame a: `p_a = T_a_b *
/// p_b`.
///
/// Position in metres, heading in (−π, π] radians, counter-clockwise. Two kinds of derivative are
/// offered: the group's own (exp, log, adjoint, right Jacobian; tangent ordered x, y, θ and
/// perturbed on the right), and those in the coordinates (x, y, θ), in which ROS states its
/// covariances.
class Pose2 {
 public:
  Pose2() = default;
  Pose2(double x, double y, double theta) : x_(x), y_(y), theta_(wrapAngle(theta)) {}
  Pose2(const Eigen::Vector2d& translation, double theta)
      : Pose2(translation.x(), translation.y(), theta) {}
  explicit Pose2(const Eigen::Vector3d& coordinates)
      : Pose2(coordinates[0], coordinates[1], coordinates[2]) {}

  double x() const { return x_; }
  double y() const { return y_; }
  double theta() const { return theta_; }
  Eigen::Vector2d translation() const { return {x_, y_}; }
  Eigen::Vector3d coordinates() const { return {x_, y_, theta_}; }
  Eigen::Matrix2d rotation() const;

  Pose2 operator*(const Pose2& other) const;
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const;
  Pose2 inverse() const;

  /// The pose reached from the identity by moving for unit time with the constant body velocity
  /// `tangent`.
  static Pose2 exp(const Eigen::Vector3d& tangent);
  /// Inverse of exp, with the rotation in (−π, π].
  Eigen::Vector3d log() const;
  /// `X exp(τ) X⁻¹ = exp(X.adjoint() τ)`.
  Eigen::Matrix3d adjoint() const;

  bool isFinite() const;

 private:
  double x_ = 0.0;
  double y_ = 0.0;
  double theta_ = 0.0;
};

/// `exp(τ + δ) ≈ exp(τ) exp(J δ)`.
Eigen::Matrix3d expRightJacobian(const Eigen::Vector3d& tangent);
/// `log(X exp(δ)) ≈ log(X) + J δ`, with τ = log(X).
Eigen::Matrix3d logRightJacobian(const Eigen::Vector3d& tangent);

/// ∂(a*b)/∂a in coordinates.
Eigen::Matrix3d composeJacobianFirst(const Pose2& a, const Pose2& b);
/// ∂(a*b)/∂b in coordinates.
Eigen::Matrix3d composeJacobianSecond(const Pose2& a);
/// ∂(a⁻¹)/∂a in coordinates.
Eigen::Matrix3d inverseJacobian(const Pose2& a);
/// ∂(T*p)/∂T in coordinates.
Eigen::Matrix<double, 2, 3> actJacobian(const Pose2& pose, const Eigen::Vector2d& point);

/// The motion from a to b, seen from a: `a⁻¹ b`.
inline Pose2 between(const Pose2& a, const Pose2& b) {
  return a.inverse() * b;
}

/// Pose on the path of constant body velocity from a (ratio 0) to b (ratio 1); other ratios
/// extrapolate.
Pose2 interpolate(const Pose2& a, const Pose2& b, double ratio);

/// A pose and the covariance of its coordinates (x, y, θ) [m², m rad, rad²].
struct UncertainPose2 {
  Pose2 mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// First-order composition of independent uncertain poses.
UncertainPose2 compose(const UncertainPose2& a, const UncertainPose2& b);
/// First-order inverse.
UncertainPose2 inverse(const UncertainPose2& a);

}  // namespace sightline::geometry
