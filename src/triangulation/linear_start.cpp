#include "sightline/triangulation/linear_start.h"

#include <cmath>

#include <Eigen/QR>

namespace sightline::triangulation {

namespace {

// Least squares with columns brought to like size; nothing where they are dependent.
std::optional<Eigen::VectorXd> solveLinear(Eigen::MatrixXd columns, const Eigen::VectorXd& wanted) {
  if (columns.rows() < columns.cols()) return std::nullopt;
  const Eigen::VectorXd sizes = columns.colwise().norm().cwiseMax(1e-300);
  columns = columns * sizes.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition(columns);
  decomposition.setThreshold(1e-9);
  if (decomposition.rank() < columns.cols()) return std::nullopt;
  return decomposition.solve(wanted).cwiseQuotient(sizes);
}

}  // namespace

std::optional<ScanOrigin> startOrigin(const std::vector<StripeEdge>& edges) {
  const auto count = static_cast<Eigen::Index>(edges.size());
  Eigen::MatrixXd columns(count, 3);
  Eigen::VectorXd wanted(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const StripeEdge& edge = edges[static_cast<std::size_t>(i)];
    const double tangent = std::tan(edge.scan_angle);
    columns.row(i) << edge.depth + edge.y * tangent, 1.0, -tangent;
    wanted[i] = edge.y - edge.depth * tangent;
  }
  const auto solution = solveLinear(columns, wanted);
  if (!solution) return std::nullopt;
  const double tangent = (*solution)[0];
  const double a = (*solution)[1];
  const double b = (*solution)[2];
  const double norm = 1.0 + tangent * tangent;
  return ScanOrigin{(b - a * tangent) / norm, (a + b * tangent) / norm, std::atan(tangent)};
}

std::optional<Intrinsics> startIntrinsics(const std::vector<ImageReading>& images,
                                          const ScanOrigin& origin, double detector_length) {
  const auto count = static_cast<Eigen::Index>(images.size());
  Eigen::MatrixXd columns(count, 6);
  Eigen::VectorXd wanted(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ImageReading& image = images[static_cast<std::size_t>(i)];
    const double angle = -(image.scan_angle + origin.projected_vergence);  // in the sense of pears
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const double p = image.image_position;
    const double z = image.depth - origin.x;
    const double weight = 1.0 / (image.sigma * z);  // to first order p is multiplied by z
    columns.row(i) << p * cosine * sine, -p * cosine * cosine, -p * cosine, cosine * cosine,
        sine * cosine, -z;
    columns.row(i) *= weight;
    wanted[i] = weight * p * z;
  }
  const auto solution = solveLinear(columns, wanted);
  if (!solution) return std::nullopt;
  const Eigen::VectorXd& x = *solution;
  Intrinsics intrinsics;
  intrinsics.baseline = x[0];
  intrinsics.vergence = std::atan2(x[1], x[0]);
  intrinsics.lens_distance = x[2] * std::cos(intrinsics.vergence);
  intrinsics.focal_length = x[3] / x[0];
  intrinsics.detector_length = detector_length;
  return intrinsics;
}

}  // namespace sightline::triangulation
