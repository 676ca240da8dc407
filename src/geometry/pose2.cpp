#include "sightline/geometry/pose2.h"

namespace sightline::geometry {

namespace {

// Below this rotation the closed forms divide by nearly nothing, and their series are exact to
// rounding.
constexpr double kSmallAngle = 1e-4;

// sin(θ)/θ and (1 − cos θ)/θ.
Eigen::Vector2d arcCoefficients(double theta) {
  if (std::abs(theta) < kSmallAngle) {
    const double square = theta * theta;
    return {1.0 - square / 6.0, 0.5 * theta * (1.0 - square / 12.0)};
  }
  // Half the angle, because 1 − cos θ cancels.
  const double half_sine = std::sin(0.5 * theta);
  return {std::sin(theta) / theta, 2.0 * half_sine * half_sine / theta};
}

Eigen::Matrix2d rotationMatrix(double theta) {
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  Eigen::Matrix2d rotation;
  rotation << c, -s, s, c;
  return rotation;
}

}  // namespace

Eigen::Matrix2d Pose2::rotation() const {
  return rotationMatrix(theta_);
}

Pose2 Pose2::operator*(const Pose2& other) const {
  return {*this * other.translation(), theta_ + other.theta_};
}

Eigen::Vector2d Pose2::operator*(const Eigen::Vector2d& point) const {
  return rotation() * point + translation();
}

Pose2 Pose2::inverse() const {
  return {-(rotation().transpose() * translation()), -theta_};
}

Pose2 Pose2::exp(const Eigen::Vector3d& tangent) {
  const Eigen::Vector2d k = arcCoefficients(tangent[2]);
  return {k[0] * tangent[0] - k[1] * tangent[1], k[1] * tangent[0] + k[0] * tangent[1], tangent[2]};
}

Eigen::Vector3d Pose2::log() const {
  const Eigen::Vector2d k = arcCoefficients(theta_);
  const double norm = k.squaredNorm();
  return {(k[0] * x_ + k[1] * y_) / norm, (-k[1] * x_ + k[0] * y_) / norm, theta_};
}

Eigen::Matrix3d Pose2::adjoint() const {
  Eigen::Matrix3d adjoint = Eigen::Matrix3d::Identity();
  adjoint.topLeftCorner<2, 2>() = rotation();
  adjoint(0, 2) = y_;
  adjoint(1, 2) = -x_;
  return adjoint;
}

bool Pose2::isFinite() const {
  return std::isfinite(x_) && std::isfinite(y_) && std::isfinite(theta_);
}

Eigen::Matrix3d expRightJacobian(const Eigen::Vector3d& tangent) {
  const double x = tangent[0];
  const double y = tangent[1];
  const double theta = tangent[2];
  const Eigen::Vector2d k = arcCoefficients(theta);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 0) = jacobian(1, 1) = k[0];
  jacobian(0, 1) = k[1];
  jacobian(1, 0) = -k[1];
  if (std::abs(theta) < kSmallAngle) {
    jacobian(0, 2) = -0.5 * y + x * theta / 6.0;
    jacobian(1, 2) = 0.5 * x + y * theta / 6.0;
  } else {
    const double lag = (1.0 - k[0]) / theta;
    jacobian(0, 2) = x * lag - y * k[1] / theta;
    jacobian(1, 2) = x * k[1] / theta + y * lag;
  }
  return jacobian;
}

Eigen::Matrix3d logRightJacobian(const Eigen::Vector3d& tangent) {
  // The block structure [M v; 0 1] inverts in closed form.
  const Eigen::Matrix3d forward = expRightJacobian(tangent);
  const double norm = forward(0, 0) * forward(0, 0) + forward(0, 1) * forward(0, 1);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity();
  inverse.topLeftCorner<2, 2>() = forward.topLeftCorner<2, 2>().transpose() / norm;
  inverse.topRightCorner<2, 1>() = -inverse.topLeftCorner<2, 2>() * forward.topRightCorner<2, 1>();
  return inverse;
}

Eigen::Matrix3d composeJacobianFirst(const Pose2& a, const Pose2& b) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  const Eigen::Vector2d moved = a.rotation() * b.translation();
  jacobian(0, 2) = -moved.y();
  jacobian(1, 2) = moved.x();
  return jacobian;
}

Eigen::Matrix3d composeJacobianSecond(const Pose2& a) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian.topLeftCorner<2, 2>() = a.rotation();
  return jacobian;
}

Eigen::Matrix3d inverseJacobian(const Pose2& a) {
  const Eigen::Vector2d t = a.inverse().translation();
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  jacobian.topLeftCorner<2, 2>() = -a.rotation().transpose();
  jacobian(0, 2) = t.y();
  jacobian(1, 2) = -t.x();
  jacobian(2, 2) = -1.0;
  return jacobian;
}

Eigen::Matrix<double, 2, 3> actJacobian(const Pose2& pose, const Eigen::Vector2d& point) {
  const Eigen::Vector2d turned = pose.rotation() * point;
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << 1.0, 0.0, -turned.y(), 0.0, 1.0, turned.x();
  return jacobian;
}

Pose2 interpolate(const Pose2& a, const Pose2& b, double ratio) {
  return a * Pose2::exp(ratio * between(a, b).log());
}

UncertainPose2 compose(const UncertainPose2& a, const UncertainPose2& b) {
  const Eigen::Matrix3d first = composeJacobianFirst(a.mean, b.mean);
  const Eigen::Matrix3d second = composeJacobianSecond(a.mean);
  return {a.mean * b.mean,
          first * a.covariance * first.transpose() + second * b.covariance * second.transpose()};
}

UncertainPose2 inverse(const UncertainPose2& a) {
  const Eigen::Matrix3d jacobian = inverseJacobian(a.mean);
  return {a.mean.inverse(), jacobian * a.covariance * jacobian.transpose()};
}

}  // namespace sightline::geometry
