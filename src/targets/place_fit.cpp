#include "sightline/targets/place_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "sightline/targets/bernoulli.h"

namespace sightline::targets {

void PlaceFit::add(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                   const std::vector<Eigen::Vector2d>& targets_map, const ErrorFit& fit,
                   double inflation) {
  constexpr double kFarthest = 3.0;  // in standard deviations, beyond which an error is of others
  const double sigma = fit.sigma * fit.tail;
  if (!(sigma > 0.0)) return;
  const double weight = 1.0 / (sigma * sigma * inflation);
  for (const Opportunity& one : labelled) {
    if (!one.is_detected || std::abs(one.error) > kFarthest * sigma) continue;
    const Eigen::RowVector2d slope =
        bearingJacobians(targets_map[one.target], looks[one.look].T_map_sensor).point;
    Sums& sums = targets_[one.target];
    sums.information += weight * slope.transpose() * slope;
    sums.moment += weight * one.error * slope.transpose();
    ++sums.count;
  }
}

double PlaceFit::sigma() const {
  constexpr std::size_t kFewest = 20;
  double variance = 0.0;
  double count = 0.0;
  for (const auto& [target, sums] : targets_) {
    if (sums.count < kFewest || sums.information.determinant() <= 0.0) continue;
    const Eigen::Matrix2d covariance = sums.information.inverse();
    const Eigen::Vector2d displacement = covariance * sums.moment;
    variance += 0.5 * (displacement.squaredNorm() - covariance.trace());
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(std::max(variance / count, 0.0)) : 0.0;
}

}  // namespace sightline::targets
