#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/pipeline/even_values.h"

namespace sightline::pipeline {

/// Delay between two series of turns: those that scans show, and those that an odometry tells, of
/// which neither the scale nor a constant drift is known. At each of many delays the one is
/// regressed on the other; what is left over is the least at the true one. What came long ago
/// counts less and less.
class DelayRegression {
 public:
  /// @param delays  that are tried [s]
  explicit DelayRegression(const EvenValues& delays);

  const EvenValues& delays() const { return delays_; }

  /// Takes a turn by the scans, and the one by the odometry at each of the delays [rad].
  void add(const std::vector<double>& by_odometry, double by_scans);
  void fade(double kept);
  /// Nothing where few turns have come, or the best delay is at an end of the range.
  std::optional<Determined> delay() const;

 private:
  struct Sums {
    double weight = 0.0, odometry = 0.0, scans = 0.0;
    double odometry_squared = 0.0, product = 0.0;

    void add(double weight_of, double by_odometry, double by_scans);
    double slope() const;
    double rest(double scans_squared) const;
  };
  double weightOf(const std::vector<double>& by_odometry, double by_scans) const;

  EvenValues delays_;
  std::vector<Sums> sums_;
  double scans_squared_ = 0.0;
  std::size_t best_;
};

}  // namespace sightline::pipeline
