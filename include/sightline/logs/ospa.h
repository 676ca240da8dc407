#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace sightline::logs {

using Points = std::vector<Eigen::Vector2d>;

/// Metric between sets: order p ≥ 1 and cut-off c > 0 [m].
struct SetMetric {
  double order = 1.0;
  double cutoff = 5.0;
};

/// Optimal subpattern assignment metric (Schuhmacher, Vo and Vo 2008, eq. 3) [m]: with m ≤ n
/// points,
/// `((min_π Σ min(c, d)^p + c^p (n − m)) / n)^(1/p)`; 0 for two empty sets. Throws
/// std::invalid_argument for a metric or a point that is none.
double ospa(const Points& truth, const Points& estimate, const SetMetric& metric = {});

/// Generalised OSPA with α = 2 and what it is made of (Rahmathullah, García-Fernández and Svensson
/// 2017, prop. 1): `(Σ d^p over assigned pairs + c^p/2 (missed + false))^(1/p)`, unnormalised.
struct Gospa {
  double value = 0.0;         ///< [m]
  double localisation = 0.0;  ///< Σ d^p of the pairs [m^p]
  std::size_t missed = 0;     ///< points of the truth without a partner
  std::size_t spurious = 0;   ///< estimates without a partner
};
Gospa gospa(const Points& truth, const Points& estimate, const SetMetric& metric = {});

}  // namespace sightline::logs
