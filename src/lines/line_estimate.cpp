#include "sightline/lines/line_estimate.h"

namespace sightline::lines {

void LineEstimate::step(double rho_step, double phi_step) {
  // Half-angle form: a rotation whatever the step, without sine and cosine.
  const double half = 0.5 * phi_step;
  const double scale = 1.0 / (1.0 + half * half);
  const double c = (1.0 - half * half) * scale;
  const double s = 2.0 * half * scale;
  const double middle = -information.rho_phi / information.rho_rho;
  information = information.shifted(s * rho);
  rho = c * rho + s * middle + rho_step - phi_step * middle;
  const double x = c * normal_x - s * normal_y;
  normal_y = s * normal_x + c * normal_y;
  normal_x = x;
}

geometry::PolarLine LineEstimate::polar() const {
  const double scale = 1.0 / information.determinant();
  geometry::PolarLine line;
  line.rho = rho;
  line.phi = std::atan2(normal_y, normal_x);
  line.covariance << scale * information.phi_phi, -scale * information.rho_phi,
      -scale * information.rho_phi, scale * information.rho_rho;
  return geometry::canonical(line);
}

}  // namespace sightline::lines
