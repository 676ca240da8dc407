#include "sightline/fitting/line_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace sightline::fitting {

namespace {

using geometry::PolarLine;

struct LineFitConstants {
  // Gauss-Newton: a step this far below the standard deviations no longer matters.
  int most_iterations = 30;
  double converged = 1e-4;
  // Ratio of the information added to its diagonal once a step has led uphill
  // (Levenberg-Marquardt).
  double first_damping = 1e-2;
  // Points within this distance of each other are one place [m].
  double one_place = 1e-9;
};
constexpr LineFitConstants kLineFit{};

struct NormalEquations {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  double chi_square = 0.0;
};

// Residual e = n·p − ρ over its standard deviation s(φ) = sqrt(nᵀ C n); s turns with the line, so
// it is differentiated too. All sums are of squares of 1 / s: no root is needed.
NormalEquations linearise(const std::vector<NoisyPoint>& points, const Eigen::Vector2d& line) {
  const Eigen::Vector2d normal(std::cos(line[1]), std::sin(line[1]));
  const Eigen::Vector2d along(-normal.y(), normal.x());
  NormalEquations equations;
  for (const NoisyPoint& point : points) {
    const Eigen::Vector2d spread = point.covariance * normal;
    const double weight = 1.0 / normal.dot(spread);
    const double residual = normal.dot(point.position) - line[0];
    const double turn = along.dot(spread) * weight;
    const Eigen::Vector2d jacobian(-1.0, along.dot(point.position) - residual * turn);
    equations.information += weight * jacobian * jacobian.transpose();
    equations.gradient += weight * residual * jacobian;
    equations.chi_square += weight * residual * residual;
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
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double weights = 0.0;
  for (const NoisyPoint& point : points) {
    const double weight = 1.0 / std::max(axis.dot(point.covariance * axis), 1e-12);
    const double x = axis.dot(point.position - centroid);
    const double y = across.dot(point.position - centroid);
    xx += weight * x * x;
    xy += weight * x * y;
    yy += weight * y * y;
    weights += weight;
  }
  if (!(std::max(xx, yy) > kLineFit.one_place * kLineFit.one_place * weights)) return std::nullopt;
  // Seen edge-on the line runs along the axis, and y' = a x' + b is the fit that tells its slope.
  const double tilt = yy >= xx ? std::atan(xy / yy) : 0.5 * geometry::kPi - std::atan(xy / xx);
  PolarLine line;
  line.phi = bearing - tilt;
  line.rho = line.normal().dot(centroid);
  return geometry::canonical(line);
}

std::optional<LineFit> refineLine(const std::vector<NoisyPoint>& points, const PolarLine& start) {
  if (points.size() < 2) return std::nullopt;
  Eigen::Vector2d line(start.rho, start.phi);
  NormalEquations equations = linearise(points, line);
  double damping = 0.0;
  for (int iteration = 0; iteration < kLineFit.most_iterations; ++iteration) {
    if (!isDetermined(equations.information)) return std::nullopt;
    const Eigen::Matrix2d covariance = equations.information.inverse();
    if (equations.gradient.dot(covariance * equations.gradient) <
        kLineFit.converged * kLineFit.converged) {
      return LineFit{geometry::canonical({line[0], line[1], covariance}), equations.chi_square,
                     points.size() - 2};
    }
    Eigen::Matrix2d damped = equations.information;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::Vector2d next = line - damped.inverse() * equations.gradient;
    const NormalEquations there = linearise(points, next);
    const bool downhill = there.chi_square < equations.chi_square;
    damping = downhill ? 0.1 * damping : std::max(kLineFit.first_damping, 10.0 * damping);
    if (!downhill) continue;
    line = next;
    equations = there;
  }
  return std::nullopt;
}

std::optional<LineFit> fitLine(const std::vector<NoisyPoint>& points) {
  const auto start = startLine(points);
  return start ? refineLine(points, *start) : std::nullopt;
}

}  // namespace sightline::fitting
