#include "sightline/triangulation/calibration_residuals.h"

#include <cmath>

#include "sightline/triangulation/projection_geometry.h"

namespace sightline::triangulation {

namespace {

enum Parameter { kFocalLength, kBaseline, kVergence, kLensDistance, kX, kY, kProjectedVergence };

using Gradient = Eigen::Matrix<double, 1, kParameterCount>;

// Sensor of a parameter vector. Throws config::Error.
struct Model {
  Model(const ParameterVector& parameters, double detector_length)
      : geometry(intrinsicsOf(parameters, detector_length)),
        origin{parameters[kX], parameters[kY], parameters[kProjectedVergence]} {}

  static Intrinsics intrinsicsOf(const ParameterVector& parameters, double detector_length) {
    return {parameters[kFocalLength], parameters[kBaseline], parameters[kVergence],
            parameters[kLensDistance], detector_length};
  }
  double angle(const ImageReading& image) const {
    return image.scan_angle + origin.projected_vergence;
  }
  double range(const ImageReading& image) const {
    return (image.depth - origin.x) / std::cos(angle(image));
  }

  ProjectionGeometry geometry;
  ScanOrigin origin;
};

double residualOf(const ImageReading& image, const Model& model) {
  const double predicted = model.geometry.imagePosition(model.range(image), model.angle(image));
  return (image.image_position - predicted) / image.sigma;
}

double residualOf(const StripeEdge& edge, const Model& model) {
  const ScanOrigin& origin = model.origin;
  const double angle = std::atan2(edge.y - origin.y, edge.depth - origin.x);
  return (edge.scan_angle + origin.projected_vergence - angle) / edge.sigma;
}

Gradient gradientOf(const ImageReading& image, const Model& model) {
  const double angle = model.angle(image);
  const double range = model.range(image);
  const Eigen::RowVector2d by_range_angle = model.geometry.imagePositionJacobian(range, angle);
  Gradient row;
  row << model.geometry.intrinsicsJacobian(range, angle), -by_range_angle[0] / std::cos(angle), 0.0,
      by_range_angle[0] * range * std::tan(angle) + by_range_angle[1];
  return -row / image.sigma;
}

Gradient gradientOf(const StripeEdge& edge, const Model& model) {
  const double ahead = edge.depth - model.origin.x;
  const double aside = edge.y - model.origin.y;
  const double squared = ahead * ahead + aside * aside;
  Gradient row;
  row << 0.0, 0.0, 0.0, 0.0, -aside / squared, ahead / squared, 1.0;
  return row / edge.sigma;
}

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
  const Model model(parameters, detector_length_);
  Eigen::VectorXd residuals(size());
  Eigen::Index i = 0;
  for (const ImageReading& image : images_) residuals[i++] = residualOf(image, model);
  for (const StripeEdge& edge : edges_) residuals[i++] = residualOf(edge, model);
  return residuals;
}

Eigen::Matrix<double, Eigen::Dynamic, kParameterCount> CalibrationResiduals::jacobianAt(
    const ParameterVector& parameters) const {
  const Model model(parameters, detector_length_);
  Eigen::Matrix<double, Eigen::Dynamic, kParameterCount> jacobian(size(), kParameterCount);
  Eigen::Index i = 0;
  for (const ImageReading& image : images_) jacobian.row(i++) = gradientOf(image, model);
  for (const StripeEdge& edge : edges_) jacobian.row(i++) = gradientOf(edge, model);
  return jacobian;
}

}  // namespace sightline::triangulation
