#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/pipeline/even_values.h"

namespace sightline::pipeline {

/// Sum of robust costs over evenly spaced values of one parameter, to which data come one by one.
/// What came long ago counts less and less.
class CostProfile {
 public:
  /// @param scale  of residuals that still count in full
  CostProfile(const EvenValues& values, double scale);

  /// Takes a residual as a function of the parameter's value.
  template <typename Residual>
  void add(const Residual& residual) {
    count_ += 1.0;
    for (std::size_t i = 0; i < costs_.size(); ++i) costs_[i] += costOf(residual(values_.at(i)));
  }
  /// Ages everything that came before.
  void fade(double kept);

  /// Value of the least cost; nothing where few data have come, or the least cost is at an end of
  /// the range.
  std::optional<Determined> least() const;

 private:
  double costOf(double residual) const;

  EvenValues values_;
  double scale_;
  double count_ = 0.0;
  std::vector<double> costs_;
};

}  // namespace sightline::pipeline
