#pragma once

#include <map>
#include <vector>

#include "sightline/targets/likelihood_fit.h"

namespace sightline::targets {

/// Displacement of targets from their known places that bearings agree on: what is seen is not
/// where the target is said to be, or the sensor is not where its pose says. More looks do not
/// average it out.
class PlaceFit {
 public:
  /// Detections of one robot, their errors being those that bias and lag leave. `inflation` as
  /// inflationOf.
  void add(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
           const std::vector<Eigen::Vector2d>& targets_map, const ErrorFit& fit, double inflation);
  /// Standard deviation of a displacement in x and in y, that of its estimate taken off [m]; 0
  /// where there are too few detections.
  double sigma() const;

 private:
  struct Sums {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    std::size_t count = 0;
  };
  std::map<std::size_t, Sums> targets_;
};

}  // namespace sightline::targets
