#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

namespace sightline::dead_reckoning {

// PointSums over points 0 .. i-1, so that those of any stretch are a difference.
struct PointSums {
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  PointSums with(const Eigen::Vector2d& p) const {
    return {x + p.x(), y + p.y(), xx + p.x() * p.x(), xy + p.x() * p.y(), yy + p.y() * p.y()};
  }
  PointSums operator-(const PointSums& o) const {
    return {x - o.x, y - o.y, xx - o.xx, xy - o.xy, yy - o.yy};
  }
};

/// Line through points, by total least squares.
struct FittedLine {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  // Mean square of the residuals; infinite before the first fit.
  double mean_square = std::numeric_limits<double>::infinity();
  double extent = 0.0;  // sum of squared distances from the centre along the line
  double free = 1.0;    // points less the parameters that were taken from them
};

inline FittedLine fitLine(const PointSums& sums, std::size_t count) {
  const double n = static_cast<double>(count);
  const Eigen::Vector2d centre(sums.x / n, sums.y / n);
  const double xx = sums.xx / n - centre.x() * centre.x();
  const double yy = sums.yy / n - centre.y() * centre.y();
  const double xy = sums.xy / n - centre.x() * centre.y();
  const double half = 0.5 * (xx - yy);
  const double root = std::sqrt(half * half + xy * xy);
  const double smaller = 0.5 * (xx + yy) - root;
  // Two equations give the eigenvector: this is the one that does not cancel.
  const Eigen::Vector2d normal =
      half > 0.0 ? Eigen::Vector2d(-xy, half + root) : Eigen::Vector2d(root - half, -xy);
  // Two parameters were taken from the points.
  const double free = std::max(1.0, n - 2.0);
  const double larger = xx + yy - smaller;
  const double mean_square = std::max(0.0, smaller) * n / free;
  return {centre, normal.normalized(), mean_square, n * larger, free};
}

}  // namespace sightline::dead_reckoning
