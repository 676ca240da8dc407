#pragma once

#include <cstddef>
#include <vector>

#include "sightline/targets/likelihood_fit.h"

namespace sightline::targets {

/// Looks of one robot for PlaceFit.
struct PlaceLooks {
  std::vector<KnownLook> looks;
  LabellingConfig labelling;  ///< with the bias and lag of the sensor
  ErrorFit errors;
  double inflation = 1.0;  ///< as inflationOf
};

/// Displacement of targets from their known places that bearings agree on: what is seen is not
/// where the target is said to be, or the sensor is not where its pose says. More looks do not
/// average it out.
class PlaceFit {
 public:
  explicit PlaceFit(std::vector<Eigen::Vector2d> targets_map)
      : targets_map_(std::move(targets_map)) {}

  void add(PlaceLooks robot) { robots_.push_back(std::move(robot)); }
  /// Standard deviation of a displacement in x and in y, that of its estimate taken off [m]; 0
  /// where there are too few detections. Bearings are given to targets anew where these are seen
  /// by now: near ones of a displaced target lie beyond the gate about its known place.
  double sigma() const;

 private:
  struct Sums {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    std::size_t count = 0;

    bool isEnough() const;
    void add(double weight, double error, const Eigen::RowVector2d& slope);
  };
  std::vector<Sums> sumsAt(const std::vector<Eigen::Vector2d>& seen_map) const;

  std::vector<Eigen::Vector2d> targets_map_;
  std::vector<PlaceLooks> robots_;
};

}  // namespace sightline::targets
