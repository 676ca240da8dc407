#include "sightline/targets/error_mixture.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::targets {

namespace {

double errorDensity(double scaled, double sigma) {
  return std::exp(-0.5 * scaled * scaled) / (sigma * std::sqrt(2.0 * geometry::kPi));
}

}  // namespace

ErrorMixture::Densities ErrorMixture::densitiesAt(double error, double gate) const {
  const double scaled = (error - bias) / sigma;
  return {core * errorDensity(scaled, sigma), wide * errorDensity(scaled / kWide, kWide * sigma),
          (1.0 - core - wide) / (2.0 * gate)};
}

double ErrorMixture::weightOf(double error, double gate) const {
  const Densities at = densitiesAt(error, gate);
  return (at.core + at.wide / (kWide * kWide)) / at.sum();
}

void ErrorMixture::step(const std::vector<double>& errors, double gate) {
  double cores = 0.0, wides = 0.0, weights = 0.0, sum = 0.0, squares = 0.0;
  for (const double error : errors) {
    const Densities at = densitiesAt(error, gate);
    const double of_core = at.core / at.sum();
    const double of_wide = at.wide / at.sum();
    // The wider one's errors, scaled to the core's.
    const double weight = of_core + of_wide / (kWide * kWide);
    cores += of_core;
    wides += of_wide;
    weights += weight;
    sum += weight * error;
    squares += weight * error * error;
  }
  bias = sum / weights;
  sigma = std::sqrt(std::max((squares - weights * bias * bias) / (cores + wides), 1e-10));
  const auto count = static_cast<double>(errors.size());
  core = std::min(cores / count, 1.0 - 1e-6);
  wide = std::min(wides / count, 1.0 - 1e-6 - core);
}

ErrorMixture ErrorMixture::of(const std::vector<double>& errors, double gate) {
  constexpr int kSteps = 200;
  ErrorMixture mixture;
  mixture.sigma = gate / 3.0;
  for (int i = 0; i < kSteps; ++i) mixture.step(errors, gate);
  return mixture;
}

double ErrorMixture::logLikelihood(const std::vector<double>& errors, double gate) const {
  double sum = 0.0;
  for (const double error : errors) sum += std::log(densitiesAt(error, gate).sum());
  return sum;
}

double ErrorMixture::tail() const {
  return std::sqrt((core + kWide * kWide * wide) / (core + wide));
}

}  // namespace sightline::targets
