#include "sightline/fitting/arc_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace sightline::fitting {

namespace {

constexpr double kEverything = 1e12;

struct ArcFitConstants {
  // Gauss-Newton. The first steps take everything in, as the start may be off by more than the
  // gate.
  int most_steps = 25;
  int open_steps = 3;
  double settled = 1e-4;  // squared step in standard deviations
  // Below these the numbers determine no circle.
  std::size_t least_returns = 3;
  double least_condition = 1e-13;
  // Residuals are divided by no less than this [m].
  double least_sigma = 1e-6;
};
constexpr ArcFitConstants kArcFit{};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// One observation of (x, y, radius).
struct Residual {
  double value;
  double variance;
  Eigen::Vector3d jacobian;
  double squared() const { return value * value / variance; }
};

// Everything but the distance itself is taken where the beam should have met the circle, which the
// noise of its range has no part in: weights and derivatives that followed it would bias the fit.
Residual residualOf(const ArcReturn& of, const ArcFit& circle) {
  const Eigen::Vector2d offset = of.point - circle.centre;
  // Past the rim there are no returns; the outermost is half a beam from it on average.
  const double rim = std::max(0.0, 1.0 - 0.5 * of.spacing / circle.radius);
  const double lateral = std::clamp(cross(of.direction, offset) / circle.radius, -rim, rim);
  const double grazing = lateral * lateral;
  const double facing = std::sqrt(1.0 - grazing);
  const Eigen::Vector2d left(-of.direction.y(), of.direction.x());
  const Eigen::Vector2d normal = lateral * left - (circle.convex ? facing : -facing) * of.direction;
  // A step t along the beam changes the distance by t cos + t² sin² / 2R.
  const double bend = 0.5 * grazing * of.range_variance / circle.radius;
  Residual residual;
  residual.value = offset.norm() - circle.radius - bend;
  residual.variance = facing * facing * of.range_variance + grazing * of.across_variance +
                      2.0 * bend * bend + kArcFit.least_sigma * kArcFit.least_sigma;
  residual.jacobian << -normal.x(), -normal.y(), -1.0;
  return residual;
}

Residual residualOf(const ArcTangent& of, const ArcFit& circle) {
  const double offset = cross(of.direction, circle.centre - of.origin);
  const double side = offset < 0.0 ? -1.0 : 1.0;
  Residual residual;
  residual.value = side * offset - circle.radius;
  residual.variance = of.variance + kArcFit.least_sigma * kArcFit.least_sigma;
  residual.jacobian << -side * of.direction.y(), side * of.direction.x(), -1.0;
  return residual;
}

// ∂(x, y, radius) by the value of one residual.
Eigen::Vector3d responseOf(const Residual& residual, const ArcFit& fit, double gate) {
  if (residual.squared() > gate * gate) return Eigen::Vector3d::Zero();
  return -fit.covariance * residual.jacobian / residual.variance;
}

struct Normals {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double chi_square = 0.0;
  std::size_t returns = 0;
  std::size_t tangents = 0;

  template <class Observation>
  std::size_t add(const std::vector<Observation>& observations, const ArcFit& circle,
                  double gate_squared) {
    std::size_t inside = 0;
    for (const Observation& observation : observations) {
      const Residual residual = residualOf(observation, circle);
      const double squared = residual.squared();
      if (squared > gate_squared) continue;
      ++inside;
      chi_square += squared;
      information += residual.jacobian * residual.jacobian.transpose() / residual.variance;
      gradient += residual.jacobian * (residual.value / residual.variance);
    }
    return inside;
  }
};

Normals normalsOf(const ArcObservations& observations, const ArcFit& circle, double gate_squared) {
  Normals normals;
  normals.returns = normals.add(observations.returns, circle, gate_squared);
  normals.tangents = normals.add(observations.tangents, circle, gate_squared);
  return normals;
}

// No further than the linearisation can be trusted.
std::optional<Eigen::Vector3d> stepOf(const Normals& normals, const ArcFit& circle) {
  if (normals.returns < kArcFit.least_returns) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> solver(normals.information);
  if (!solver.isPositive() || !(solver.rcond() > kArcFit.least_condition)) return std::nullopt;
  Eigen::Vector3d step = -solver.solve(normals.gradient);
  if (!step.allFinite()) return std::nullopt;
  const double longest = 0.5 * circle.radius / std::max(step.cwiseAbs().maxCoeff(), 1e-300);
  return longest < 1.0 ? Eigen::Vector3d(longest * step) : step;
}

// Seen from outside by all (1), from inside by all (-1), or by some and some (0).
int side(const ArcObservations& observations, const ArcFit& circle) {
  std::size_t outside = 0;
  for (const ArcReturn& of : observations.returns) {
    if ((of.point - circle.centre).dot(of.direction) <= 0.0) ++outside;
  }
  // Noise may put a return at the rim behind it.
  const std::size_t few = observations.returns.size() / 8;
  if (outside + few >= observations.returns.size()) return 1;
  return outside <= few ? -1 : 0;
}

std::optional<ArcFit> finished(const ArcObservations& observations, const ArcFit& circle,
                               const Normals& normals) {
  if (!stepOf(normals, circle)) return std::nullopt;
  ArcFit result = circle;
  result.covariance = normals.information.inverse();
  result.chi_square = normals.chi_square;
  result.returns = normals.returns;
  result.tangents = normals.tangents;
  const int seen = side(observations, circle);
  result.convex = seen > 0;
  return seen == 0 ? std::nullopt : std::optional<ArcFit>(result);
}

std::optional<ArcFit> startFromTangents(const ArcObservations& observations) {
  const ArcTangent& first = observations.tangents[0];
  const ArcTangent& second = observations.tangents[1];
  const Eigen::Vector2d axis = (first.direction + second.direction).normalized();
  const double sine = 0.5 * (first.direction - second.direction).norm();
  const Eigen::Vector2d origin = 0.5 * (first.origin + second.origin);
  double nearest = 0.0;
  double weight = 0.0;
  for (const ArcReturn& of : observations.returns) {
    // The middle of the circle faces the sensor.
    const double lateral = std::abs(cross(axis, of.direction)) / sine;
    if (lateral > 0.5) continue;
    nearest += axis.dot(of.point - origin);
    weight += 1.0;
  }
  if (weight == 0.0 || !(sine > 0.0) || sine > 0.9) return std::nullopt;
  ArcFit circle;
  circle.radius = nearest / weight * sine / (1.0 - sine);
  circle.centre = origin + (nearest / weight + circle.radius) * axis;
  return circle;
}

std::optional<ArcFit> startFromPoints(const std::vector<ArcReturn>& returns) {
  Eigen::Vector2d middle(0, 0);
  for (const ArcReturn& of : returns) middle += of.point;
  middle /= static_cast<double>(returns.size());
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  Eigen::Vector2d skew(0, 0);
  for (const ArcReturn& of : returns) {
    const Eigen::Vector2d p = of.point - middle;
    moments += p * p.transpose();
    skew += p * p.squaredNorm();
  }
  if (!(moments.determinant() > 1e-12 * moments.trace() * moments.trace())) return std::nullopt;
  const Eigen::Vector2d centre = 0.5 * moments.inverse() * skew;
  ArcFit circle;
  circle.centre = middle + centre;
  circle.radius =
      std::sqrt(centre.squaredNorm() + moments.trace() / static_cast<double>(returns.size()));
  return circle;
}

}  // namespace

std::optional<ArcFit> startArc(const ArcObservations& observations) {
  if (observations.returns.size() < kArcFit.least_returns) return std::nullopt;
  if (observations.tangents.size() == 2) {
    if (const auto circle = startFromTangents(observations)) return circle;
  }
  return startFromPoints(observations.returns);
}

std::optional<ArcFit> refineArc(const ArcObservations& observations, const ArcFit& start,
                                double gate) {
  ArcFit circle = start;
  circle.convex = side(observations, circle) >= 0;
  for (int i = 0; i < kArcFit.most_steps; ++i) {
    const bool open = i < kArcFit.open_steps;
    const Normals normals = normalsOf(observations, circle, open ? kEverything : gate * gate);
    const auto step = stepOf(normals, circle);
    if (!step) return std::nullopt;
    circle.centre += step->head<2>();
    circle.radius += (*step)[2];
    if (open || step->dot(normals.information * *step) > kArcFit.settled) continue;
    return finished(observations, circle, normalsOf(observations, circle, gate * gate));
  }
  return std::nullopt;
}

Eigen::Matrix<double, 3, 2> responseTo(const ArcReturn& of, const ArcFit& fit, double gate) {
  const Residual residual = residualOf(of, fit);
  const Eigen::RowVector2d by_point = -residual.jacobian.head<2>().transpose();
  return responseOf(residual, fit, gate) * by_point;
}

Eigen::Matrix3d responseTo(const ArcTangent& of, const ArcFit& fit, double gate) {
  const Residual residual = residualOf(of, fit);
  const double side = cross(of.direction, fit.centre - of.origin) < 0.0 ? -1.0 : 1.0;
  Eigen::RowVector3d by_ray;
  by_ray << -residual.jacobian.head<2>().transpose(),
      -side * of.direction.dot(fit.centre - of.origin);
  return responseOf(residual, fit, gate) * by_ray;
}

std::optional<ArcFit> fitArc(const ArcObservations& observations, double gate) {
  const auto start = startArc(observations);
  return start ? refineArc(observations, *start, gate) : std::nullopt;
}

}  // namespace sightline::fitting
