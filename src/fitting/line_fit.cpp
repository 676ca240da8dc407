#include "sightline/fitting/line_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace sightline::fitting {

namespace {

using geometry::PolarLine;

constexpr int kMaxIterations = 20;
// Steps this far below the standard deviations no longer matter.
constexpr double kConverged = 1e-6;

struct NormalEquations {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  double chi_square = 0.0;
};

// Residual e = n·p − ρ over its standard deviation s(φ) = sqrt(nᵀ C n); s turns with the line, so
// it is differentiated too.
NormalEquations linearise(const std::vector<NoisyPoint>& points, double rho, double phi) {
  const Eigen::Vector2d normal(std::cos(phi), std::sin(phi));
  const Eigen::Vector2d along(-normal.y(), normal.x());
  NormalEquations equations;
  for (const NoisyPoint& point : points) {
    const double variance = normal.dot(point.covariance * normal);
    const double weight = 1.0 / std::sqrt(variance);
    const double residual = (normal.dot(point.position) - rho) * weight;
    const double turn = along.dot(point.covariance * normal) / variance;
    const Eigen::Vector2d jacobian(-weight, along.dot(point.position) * weight - residual * turn);
    equations.information += jacobian * jacobian.transpose();
    equations.gradient += jacobian * residual;
    equations.chi_square += residual * residual;
  }
  return equations;
}

bool isDetermined(const Eigen::Matrix2d& information) {
  const double determinant = information.determinant();
  return std::isfinite(determinant) && information(0, 0) > 0.0 &&
         determinant > 1e-12 * information(0, 0) * information(1, 1);
}

}  // namespace

std::optional<PolarLine> startLine(const std::vector<NoisyPoint>& points) {
  if (points.size() < 2) return std::nullopt;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  double total = 0.0;
  for (const NoisyPoint& point : points) {
    const double weight = 1.0 / point.covariance.trace();
    centroid += weight * point.position;
    total += weight;
  }
  centroid /= total;
  const double bearing = std::atan2(centroid.y(), centroid.x());
  const Eigen::Vector2d axis(std::cos(bearing), std::sin(bearing));
  const Eigen::Vector2d across(-axis.y(), axis.x());

  // x' = a y' + b, with x' along the axis, both about the centroid.
  double yy = 0.0;
  double xy = 0.0;
  for (const NoisyPoint& point : points) {
    const double weight = 1.0 / std::max(axis.dot(point.covariance * axis), 1e-12);
    const Eigen::Vector2d offset = point.position - centroid;
    yy += weight * across.dot(offset) * across.dot(offset);
    xy += weight * across.dot(offset) * axis.dot(offset);
  }
  if (!(yy > 0.0)) return std::nullopt;
  const double tilt = std::atan(xy / yy);
  PolarLine line;
  line.phi = bearing - tilt;
  line.rho = line.normal().dot(centroid);
  return geometry::canonical(line);
}

std::optional<LineFit> refineLine(const std::vector<NoisyPoint>& points, const PolarLine& start) {
  if (points.size() < 2) return std::nullopt;
  double rho = start.rho;
  double phi = start.phi;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const NormalEquations equations = linearise(points, rho, phi);
    if (!isDetermined(equations.information)) return std::nullopt;
    const Eigen::Vector2d step = -equations.information.inverse() * equations.gradient;
    rho += step[0];
    phi += step[1];
    if (step.dot(equations.information * step) < kConverged * kConverged) break;
  }
  const NormalEquations equations = linearise(points, rho, phi);
  if (!isDetermined(equations.information) || !std::isfinite(rho) || !std::isfinite(phi)) {
    return std::nullopt;
  }
  LineFit fit;
  fit.line = geometry::canonical({rho, phi, equations.information.inverse()});
  fit.chi_square = equations.chi_square;
  fit.degrees_of_freedom = points.size() - 2;
  return fit;
}

std::optional<LineFit> fitLine(const std::vector<NoisyPoint>& points) {
  const auto start = startLine(points);
  return start ? refineLine(points, *start) : std::nullopt;
}

}  // namespace sightline::fitting
