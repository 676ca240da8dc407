#pragma once

#include <cmath>

#include "sightline/geometry/polar_line.h"

namespace sightline::lines {

/// Information about (ρ, φ): inverse of the covariance [1/m², 1/(m rad), 1/rad²].
struct Information {
  double rho_rho = 0.0;
  double rho_phi = 0.0;
  double phi_phi = 0.0;

  double determinant() const { return rho_rho * phi_phi - rho_phi * rho_phi; }
  /// Whether the inverse exists to the accuracy of the numbers.
  bool isDetermined() const {
    const double d = determinant();
    return rho_rho > 0.0 && d > 1e-12 * rho_rho * phi_phi && std::isfinite(d);
  }
};

/// A polar line being estimated. Its normal is held as a unit vector, so that no beam and no update
/// needs a trigonometric function; ρ may pass through zero on the way.
struct LineEstimate {
  double normal_x = 1.0;
  double normal_y = 0.0;
  double rho = 0.0;
  Information information;

  /// Moves the line by a step in (ρ, φ). The turn is exact to third order in `phi_step`.
  void step(double rho_step, double phi_step);
  /// Direction of the line, 90° counter-clockwise from the normal: `along · p` is a position on it.
  double alongX() const { return -normal_y; }
  double alongY() const { return normal_x; }
  geometry::PolarLine polar() const;
};

}  // namespace sightline::lines
