#pragma once

#include <cmath>

#include "lines/room_scan.h"

namespace sightline::test {

/// Two walls of three metres that meet ahead of the sensor, at (0, 3), and turn by so much there.
inline ScanOf wallsThatTurn(double turn, double sigma) {
  ScanOf of = wallAhead(3.0, 0.0, 3.0);
  const Eigen::Vector2d corner(0.0, 3.0);
  of.walls.push_back({corner, corner + 3.0 * Eigen::Vector2d(-std::cos(turn), -std::sin(turn))});
  of.noise.sigma = sigma;
  return of;
}

}  // namespace sightline::test
