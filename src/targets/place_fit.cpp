#include "sightline/targets/place_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "sightline/targets/bernoulli.h"

namespace sightline::targets {

bool PlaceFit::Sums::isEnough() const {
  constexpr std::size_t kFewest = 20;
  return count >= kFewest && information.determinant() > 0.0;
}

void PlaceFit::Sums::add(double weight, double error, const Eigen::RowVector2d& slope) {
  information += weight * slope.transpose() * slope;
  moment += weight * error * slope.transpose();
  ++count;
}

std::vector<PlaceFit::Sums> PlaceFit::sumsAt(const std::vector<Eigen::Vector2d>& seen_map) const {
  std::vector<Sums> sums(seen_map.size());
  for (const PlaceLooks& robot : robots_) {
    if (!(robot.errors.sigma > 0.0)) continue;
    for (const Opportunity& one : label(robot.looks, seen_map, robot.labelling).opportunities) {
      if (!one.is_detected) continue;
      const KnownLook& look = robot.looks[one.look];
      const double sigma = robot.errors.sigmaAt(look.turn_rate);
      sums[one.target].add(1.0 / (sigma * sigma * robot.inflation), one.error,
                           bearingJacobians(seen_map[one.target], look.T_map_sensor).point);
    }
  }
  return sums;
}

double PlaceFit::sigma() const {
  constexpr int kRounds = 4;
  std::vector<Eigen::Vector2d> seen_map = targets_map_;
  std::vector<Sums> sums;
  for (int round = 0; round < kRounds; ++round) {
    sums = sumsAt(seen_map);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (sums[i].isEnough()) seen_map[i] += sums[i].information.inverse() * sums[i].moment;
    }
  }
  double variance = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!sums[i].isEnough()) continue;
    const double square = (seen_map[i] - targets_map_[i]).squaredNorm();
    variance += 0.5 * (square - sums[i].information.inverse().trace());
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(std::max(variance / count, 0.0)) : 0.0;
}

}  // namespace sightline::targets
