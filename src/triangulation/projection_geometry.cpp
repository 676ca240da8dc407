#include "sightline/triangulation/projection_geometry.h"

#include <cmath>

namespace sightline::triangulation {

namespace {

const Intrinsics& validated(const Intrinsics& intrinsics) {
  config::validate(intrinsics);
  return intrinsics;
}

}  // namespace

ProjectionGeometry::ProjectionGeometry(const Intrinsics& intrinsics)
    : intrinsics_(validated(intrinsics)) {}

ProjectionGeometry::Lens ProjectionGeometry::lens(double angle) const {
  const double direction = angle + intrinsics_.vergence;
  const Eigen::Vector2d axis(std::cos(direction), std::sin(direction));
  return {Eigen::Vector2d(0.0, -intrinsics_.baseline) - intrinsics_.lens_distance * axis, axis};
}

ProjectionGeometry::FromLens ProjectionGeometry::fromLens(double range, double angle) const {
  const double axis = angle + intrinsics_.vergence;
  return {intrinsics_.baseline * std::cos(axis) - range * std::sin(intrinsics_.vergence),
          range * std::cos(intrinsics_.vergence) + intrinsics_.baseline * std::sin(axis) +
              intrinsics_.lens_distance};
}

double ProjectionGeometry::imagePosition(double range, double angle) const {
  const FromLens point = fromLens(range, angle);
  return intrinsics_.focal_length * point.across / point.along;
}

double ProjectionGeometry::imagePosition(const Eigen::Vector2d& point, const Lens& lens) const {
  const Eigen::Vector2d offset = point - lens.centre;
  const double across = lens.axis.x() * offset.y() - lens.axis.y() * offset.x();
  return intrinsics_.focal_length * across / lens.axis.dot(offset);
}

double ProjectionGeometry::range(double image_position, double angle) const {
  const auto& [f, d, gamma, s, length] = intrinsics_;
  const double axis = angle + gamma;
  return (f * d * std::cos(axis) - image_position * (d * std::sin(axis) + s)) /
         (f * std::sin(gamma) + image_position * std::cos(gamma));
}

Eigen::Vector2d ProjectionGeometry::point(double image_position, double angle) const {
  return range(image_position, angle) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

double ProjectionGeometry::depth(double image_position, double angle) const {
  return range(image_position, angle) * std::cos(angle);
}

double ProjectionGeometry::rangeGain(double image_position, double angle) const {
  const auto& [f, d, gamma, s, length] = intrinsics_;
  const double denominator = f * std::sin(gamma) + image_position * std::cos(gamma);
  return -(d * std::sin(angle + gamma) + s + range(image_position, angle) * std::cos(gamma)) /
         denominator;
}

double ProjectionGeometry::depthGain(double image_position, double angle) const {
  return rangeGain(image_position, angle) * std::cos(angle);
}

Eigen::RowVector2d ProjectionGeometry::imagePositionJacobian(double range, double angle) const {
  const auto& [f, d, gamma, s, length] = intrinsics_;
  const FromLens point = fromLens(range, angle);
  const double axis = angle + gamma;
  const double p = point.across / point.along;  // over f
  const double scale = f / point.along;
  return {scale * (-std::sin(gamma) - p * std::cos(gamma)),
          scale * d * (-std::sin(axis) - p * std::cos(axis))};
}

Eigen::RowVector4d ProjectionGeometry::intrinsicsJacobian(double range, double angle) const {
  const auto& [f, d, gamma, s, length] = intrinsics_;
  const FromLens point = fromLens(range, angle);
  const double axis = angle + gamma;
  const double p = point.across / point.along;  // over f
  const double scale = f / point.along;
  const double across_by_vergence = -d * std::sin(axis) - range * std::cos(gamma);
  const double along_by_vergence = d * std::cos(axis) - range * std::sin(gamma);
  return {p, scale * (std::cos(axis) - p * std::sin(axis)),
          scale * (across_by_vergence - p * along_by_vergence), -scale * p};
}

Eigen::Matrix2d ProjectionGeometry::pointJacobian(double image_position, double angle) const {
  const auto& [f, d, gamma, s, length] = intrinsics_;
  const double axis = angle + gamma;
  const double denominator = f * std::sin(gamma) + image_position * std::cos(gamma);
  const double range_by_angle =
      -d * (f * std::sin(axis) + image_position * std::cos(axis)) / denominator;
  const double r = range(image_position, angle);
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::Matrix2d jacobian;
  jacobian << rangeGain(image_position, angle) * along, range_by_angle * along + r * across;
  return jacobian;
}

}  // namespace sightline::triangulation
