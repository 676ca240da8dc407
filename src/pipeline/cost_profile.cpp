#include "sightline/pipeline/cost_profile.h"

#include <algorithm>
#include <cmath>

namespace sightline::pipeline {

namespace {

constexpr double kFewest = 20.0;  // residuals that tell something

}  // namespace

CostProfile::CostProfile(double widest, double step, double scale)
    : widest_(widest),
      step_(step),
      scale_(scale),
      costs_(2 * static_cast<std::size_t>(std::lround(widest / step)) + 1, 0.0) {}

double CostProfile::value(std::size_t i) const {
  return -widest_ + step_ * static_cast<double>(i);
}

double CostProfile::costOf(double residual) const {
  return scale_ * scale_ * std::log1p(residual * residual / (scale_ * scale_));
}

void CostProfile::fade(double kept) {
  count_ *= kept;
  for (double& cost : costs_) cost *= kept;
}

// Vertex of the parabola through the least cost and its neighbours. A rise by twice the mean
// cost of one residual, which is its variance, is two sigmas squared over two: one sigma.
std::optional<Determined> CostProfile::least() const {
  if (count_ < kFewest) return std::nullopt;
  const auto least = std::min_element(costs_.begin(), costs_.end());
  if (least == costs_.begin() || least == std::prev(costs_.end())) return std::nullopt;
  const double before = *std::prev(least);
  const double after = *std::next(least);
  const double bend = before - 2.0 * *least + after;
  if (!(bend > 0.0)) return std::nullopt;
  const double index = static_cast<double>(least - costs_.begin()) + 0.5 * (before - after) / bend;
  const double variance = *least / count_;  // of one residual
  return Determined{-widest_ + step_ * index, step_ * std::sqrt(2.0 * variance / bend)};
}

}  // namespace sightline::pipeline
