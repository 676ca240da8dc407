#pragma once

#include <cmath>

#include "sightline/geometry/polar_line.h"

namespace sightline::lines {

/// Information about (ρ, φ): inverse of the covariance [1/m², 1/(m rad), 1/rad²].
struct Information {
  double rho_rho = 0.0;
  double rho_phi = 0.0;
  double phi_phi = 0.0;

  /// The same about a line seen from an origin that lies `distance` further along it.
  Information shifted(double distance) const {
    return {rho_rho, rho_phi + distance * rho_rho,
            phi_phi + distance * (2.0 * rho_phi + distance * rho_rho)};
  }
  Information& operator+=(const Information& other) {
    rho_rho += other.rho_rho;
    rho_phi += other.rho_phi;
    phi_phi += other.phi_phi;
    return *this;
  }
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

  /// Moves the line by a step in (ρ, φ), which it takes as a turn about the middle of what the
  /// information was gathered from, and a shift: for a line far off, turning about the origin would
  /// carry it away from its own points. The information is taken along: the positions of those
  /// points along the line change by −ρ φ_step. Were it left as it is, the line would be believed
  /// better known with each step than it is, and break up (pears section 4.7).
  void step(double rho_step, double phi_step);
  /// Direction of the line, 90° counter-clockwise from the normal: `along · p` is a position on it.
  double alongX() const { return -normal_y; }
  double alongY() const { return normal_x; }
  geometry::PolarLine polar() const;
};

}  // namespace sightline::lines
