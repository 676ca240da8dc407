#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace sightline::pipeline {

/// Value of a parameter that data have determined.
struct Determined {
  double value = 0.0;
  double sigma = 0.0;  ///< standard deviation
};

/// Sum of robust costs over evenly spaced values of one parameter, to which data come one by one.
/// What came long ago counts less and less.
class CostProfile {
 public:
  /// @param widest  values from minus this to this
  /// @param step    between two values
  /// @param scale   of residuals that still count in full
  CostProfile(double widest, double step, double scale);

  std::size_t size() const { return costs_.size(); }
  double value(std::size_t i) const;

  /// Takes a residual as a function of the parameter's value, with its share in the count of what
  /// is independent.
  template <typename Residual>
  void add(const Residual& residual, double share = 1.0) {
    count_ += share;
    for (std::size_t i = 0; i < costs_.size(); ++i) {
      costs_[i] += share * costOf(residual(value(i)));
    }
  }
  /// Ages everything that came before.
  void fade(double kept);
  double count() const { return count_; }

  /// Value of the least cost; nothing where few data have come, or the least cost is at an end of
  /// the range.
  std::optional<Determined> least() const;

 private:
  double costOf(double residual) const;

  double widest_;
  double step_;
  double scale_;
  double count_ = 0.0;
  std::vector<double> costs_;
};

}  // namespace sightline::pipeline
