#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace sightline::fitting {

/// A return that may lie on a circle.
struct ArcReturn {
  Eigen::Vector2d point;         ///< where the beam ended [m]
  Eigen::Vector2d direction;     ///< unit vector along the beam
  double range_variance = 0.0;   ///< along the beam [m²]
  double across_variance = 0.0;  ///< across the beam [m²]
  double spacing = 0.0;          ///< of neighbouring beams, across them [m]
};

/// A ray that grazes the circle: it lies between the last beam that hits it and the first that
/// passes it by.
struct ArcTangent {
  Eigen::Vector2d origin;     ///< [m]
  Eigen::Vector2d direction;  ///< unit vector
  double variance = 0.0;      ///< of the distance between ray and circle [m²]
};

struct ArcObservations {
  std::vector<ArcReturn> returns;
  std::vector<ArcTangent> tangents;  ///< none, one or two
};

/// A circle with what is known of it.
struct ArcFit {
  Eigen::Vector2d centre{0, 0};
  double radius = 0.0;                                   ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< order x, y, radius [m²]
  double chi_square = 0.0;                               ///< sum of squared normalised residuals
  std::size_t returns = 0;                               ///< of which they are
  std::size_t tangents = 0;                              ///< of which they are, too
  bool convex = true;                                    ///< seen from outside

  std::size_t observations() const { return returns + tangents; }
};

/// Start: from two tangents and the nearest returns where there are two, otherwise the algebraic
/// circle through the points (Kåsa 1976). Nothing where they do not determine one.
std::optional<ArcFit> startArc(const ArcObservations& observations);

/// Maximum-likelihood circle of the observations within the gate [σ]: Gauss-Newton on the
/// distance of each return from the circle over its standard deviation. Noise along a beam that
/// grazes the circle moves the return off it to second order only, and always outwards: the
/// residual is freed of that bias, the variance has its square. The covariance is the inverse
/// information. Nothing where the observations do not determine a circle, the iteration does not
/// settle, or some returns would be seen from inside and others from outside.
std::optional<ArcFit> refineArc(const ArcObservations& observations, const ArcFit& start,
                                double gate);

/// Response of a fitted circle to a displacement of one return's end point, the others held: ∂(x,
/// y, radius) by it, zero for a return beyond the gate.
Eigen::Matrix<double, 3, 2> responseTo(const ArcReturn& of, const ArcFit& fit, double gate);
/// The same for a ray that is displaced and turned about its origin: ∂(x, y, radius) by (x, y, θ).
Eigen::Matrix3d responseTo(const ArcTangent& of, const ArcFit& fit, double gate);

/// Start and refinement in one.
std::optional<ArcFit> fitArc(const ArcObservations& observations, double gate);

}  // namespace sightline::fitting
