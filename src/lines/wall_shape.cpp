#include "sightline/lines/wall_shape.h"

namespace sightline::lines {

namespace {

// A line fitted to a random walk w over a length L, seen from the end where w is 0, is off by
// α = ∫ (4 − 6s/L) w ds/L there and turned by β = ∫ (12s/L − 6) w ds/L². For a diffusion of 1 the
// variance of α is 2L/15, that of β 6/(5L), and their covariance −1/10. Half of the gap further on
// the line has turned away, and the walk has gone on.
double turnOf(double length) {
  return 1.2 / length;
}

double offsetOf(double length, double away) {
  return 2.0 / 15.0 * length + away * (0.2 + away * turnOf(length) + 1.0);
}

}  // namespace

Eigen::Vector2d WallShape::difference(double before, double after, double gap) const {
  const double away = 0.5 * gap;
  return diffusion_ * Eigen::Vector2d(offsetOf(before, away) + offsetOf(after, away),
                                      turnOf(before) + turnOf(after));
}

}  // namespace sightline::lines
