#pragma once

#include <vector>

namespace sightline::targets {

/// Errors of bearings as a Gaussian, one 2.5 times as wide of the same mean, and an even background
/// within ±gate: mislabelled ones and outliers.
struct ErrorMixture {
  static constexpr double kWide = 2.5;  ///< standard deviation of the wider one, in those of σ

  double sigma = 1.0;  ///< of the narrower one, the core [rad]
  double bias = 0.0;   ///< [rad]
  double core = 0.6;   ///< share of the core [0, 1]
  double wide = 0.2;   ///< share of the wider one

  /// By expectation maximisation; 0 < gate [rad].
  static ErrorMixture of(const std::vector<double>& errors, double gate);

  /// Weight of an error in a mean, in those of the core: probability that it is of the core, and
  /// that it is of the wider one over the square of its width.
  double weightOf(double error, double gate) const;
  double logLikelihood(const std::vector<double>& errors, double gate) const;
  /// Standard deviation of both Gaussians together over that of the core.
  double tail() const;

 private:
  struct Densities {
    double core;
    double wide;
    double background;
    double sum() const { return core + wide + background; }
  };
  Densities densitiesAt(double error, double gate) const;
  void step(const std::vector<double>& errors, double gate);
};

}  // namespace sightline::targets
