#include "sightline/geometry/polar_line.h"

namespace sightline::geometry {

namespace {

struct Moved {
  double rho;  // before it is made non-negative
  double phi;
};

Moved move(const Pose2& T, const PolarLine& line) {
  const double phi = line.phi + T.theta();
  return {line.rho + T.x() * std::cos(phi) + T.y() * std::sin(phi), phi};
}

// Turning the normal round changes the sign of ρ and leaves dφ.
double orientation(const Moved& moved) {
  return moved.rho < 0.0 ? -1.0 : 1.0;
}

}  // namespace

PolarLine canonical(const PolarLine& line) {
  PolarLine result = line;
  if (result.rho < 0.0) {
    result.rho = -result.rho;
    result.phi += kPi;
    result.covariance(0, 1) = -result.covariance(0, 1);
    result.covariance(1, 0) = -result.covariance(1, 0);
  }
  result.phi = wrapAngle(result.phi);
  return result;
}

PolarLine transform(const Pose2& T_target_source, const PolarLine& line_source) {
  const Moved moved = move(T_target_source, line_source);
  const Eigen::Matrix2d jacobian = transformJacobianLine(T_target_source, line_source);
  PolarLine line = canonical({moved.rho, moved.phi, Eigen::Matrix2d::Zero()});
  line.covariance = jacobian * line_source.covariance * jacobian.transpose();
  return line;
}

PolarLine transform(const UncertainPose2& T_target_source, const PolarLine& line_source) {
  PolarLine line = transform(T_target_source.mean, line_source);
  const Eigen::Matrix<double, 2, 3> jacobian =
      transformJacobianPose(T_target_source.mean, line_source);
  line.covariance += jacobian * T_target_source.covariance * jacobian.transpose();
  return line;
}

Eigen::Matrix2d transformJacobianLine(const Pose2& T_target_source, const PolarLine& line_source) {
  const Moved moved = move(T_target_source, line_source);
  const double sign = orientation(moved);
  Eigen::Matrix2d jacobian;
  jacobian << sign,
      sign *
          (-T_target_source.x() * std::sin(moved.phi) + T_target_source.y() * std::cos(moved.phi)),
      0.0, 1.0;
  return jacobian;
}

Eigen::Matrix<double, 2, 3> transformJacobianPose(const Pose2& T_target_source,
                                                  const PolarLine& line_source) {
  const Moved moved = move(T_target_source, line_source);
  const double sign = orientation(moved);
  const double c = std::cos(moved.phi);
  const double s = std::sin(moved.phi);
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << sign * c, sign * s, sign * (-T_target_source.x() * s + T_target_source.y() * c),  //
      0.0, 0.0, 1.0;
  return jacobian;
}

PolarLine describedLike(const PolarLine& reference, const PolarLine& line) {
  if (std::abs(wrapAngle(line.phi - reference.phi)) <= 0.5 * kPi) return line;
  PolarLine turned = line;
  turned.rho = -line.rho;
  turned.phi = wrapAngle(line.phi + kPi);
  turned.covariance(0, 1) = -line.covariance(0, 1);
  turned.covariance(1, 0) = -line.covariance(1, 0);
  return turned;
}

Eigen::Vector2d difference(const PolarLine& a, const PolarLine& b) {
  const PolarLine like_b = describedLike(b, a);
  return {like_b.rho - b.rho, wrapAngle(like_b.phi - b.phi)};
}

}  // namespace sightline::geometry
