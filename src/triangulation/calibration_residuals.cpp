#include "sightline/triangulation/calibration_residuals.h"

#include <cmath>

#include "sightline/triangulation/projection_geometry.h"

namespace sightline::triangulation {

namespace {

enum Parameter { kFocalLength, kBaseline, kVergence, kLensDistance, kX, kY, kProjectedVergence };

}  // namespace

const std::array<ParameterName, kParameterCount> kParameterNames{
    {{"intrinsics.focal_length", "m"},
     {"intrinsics.baseline", "m"},
     {"intrinsics.vergence", "rad"},
     {"intrinsics.lens_distance", "m"},
     {"origin.x", "m"},
     {"origin.y", "m"},
     {"origin.projected_vergence", "rad"}}};

ParameterVector toVector(const Intrinsics& intrinsics, const ScanOrigin& origin) {
  ParameterVector parameters;
  parameters << intrinsics.focal_length, intrinsics.baseline, intrinsics.vergence,
      intrinsics.lens_distance, origin.x, origin.y, origin.projected_vergence;
  return parameters;
}

void fromVector(const ParameterVector& parameters, Intrinsics& intrinsics, ScanOrigin& origin) {
  intrinsics.focal_length = parameters[kFocalLength];
  intrinsics.baseline = parameters[kBaseline];
  intrinsics.vergence = parameters[kVergence];
  intrinsics.lens_distance = parameters[kLensDistance];
  origin = {parameters[kX], parameters[kY], parameters[kProjectedVergence]};
}

CalibrationResiduals::CalibrationResiduals(std::vector<ImageReading> images,
                                           std::vector<StripeEdge> edges, double detector_length)
    : images_(std::move(images)), edges_(std::move(edges)), detector_length_(detector_length) {}

Eigen::Index CalibrationResiduals::size() const {
  return static_cast<Eigen::Index>(images_.size() + edges_.size());
}

Eigen::VectorXd CalibrationResiduals::at(const ParameterVector& parameters) const {
  Intrinsics intrinsics;
  ScanOrigin origin;
  intrinsics.detector_length = detector_length_;
  fromVector(parameters, intrinsics, origin);
  const ProjectionGeometry geometry(intrinsics);
  Eigen::VectorXd residuals(size());
  Eigen::Index i = 0;
  for (const ImageReading& image : images_) {
    const double angle = image.scan_angle + origin.projected_vergence;
    const double range = (image.depth - origin.x) / std::cos(angle);
    residuals[i++] = (image.image_position - geometry.imagePosition(range, angle)) / image.sigma;
  }
  for (const StripeEdge& edge : edges_) {
    const double angle = std::atan2(edge.y - origin.y, edge.depth - origin.x);
    residuals[i++] = (edge.scan_angle + origin.projected_vergence - angle) / edge.sigma;
  }
  return residuals;
}

Eigen::Matrix<double, Eigen::Dynamic, kParameterCount> CalibrationResiduals::jacobianAt(
    const ParameterVector& parameters) const {
  Intrinsics intrinsics;
  ScanOrigin origin;
  intrinsics.detector_length = detector_length_;
  fromVector(parameters, intrinsics, origin);
  const ProjectionGeometry geometry(intrinsics);
  Eigen::Matrix<double, Eigen::Dynamic, kParameterCount> jacobian(size(), kParameterCount);
  Eigen::Index i = 0;
  for (const ImageReading& image : images_) {
    const double angle = image.scan_angle + origin.projected_vergence;
    const double range = (image.depth - origin.x) / std::cos(angle);
    const Eigen::RowVector2d by_range_angle = geometry.imagePositionJacobian(range, angle);
    ParameterVector row = ParameterVector::Zero();
    row.head<4>() = geometry.intrinsicsJacobian(range, angle).transpose();
    row[kX] = -by_range_angle[0] / std::cos(angle);
    row[kProjectedVergence] = by_range_angle[0] * range * std::tan(angle) + by_range_angle[1];
    jacobian.row(i++) = -row.transpose() / image.sigma;
  }
  for (const StripeEdge& edge : edges_) {
    const double ahead = edge.depth - origin.x;
    const double aside = edge.y - origin.y;
    const double squared = ahead * ahead + aside * aside;
    ParameterVector row = ParameterVector::Zero();
    row[kX] = -aside / squared;
    row[kY] = ahead / squared;
    row[kProjectedVergence] = 1.0;
    jacobian.row(i++) = row.transpose() / edge.sigma;
  }
  return jacobian;
}

}  // namespace sightline::triangulation
