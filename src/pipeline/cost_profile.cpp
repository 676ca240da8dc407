#include "sightline/pipeline/cost_profile.h"

#include <algorithm>
#include <cmath>

namespace sightline::pipeline {

namespace {

constexpr double kFewest = 20.0;  // residuals that tell something

}  // namespace

CostProfile::CostProfile(const EvenValues& values, double scale)
    : values_(values), scale_(scale), costs_(values.size(), 0.0) {}

double CostProfile::costOf(double residual) const {
  return scale_ * scale_ * std::log1p(residual * residual / (scale_ * scale_));
}

void CostProfile::fade(double kept) {
  count_ *= kept;
  for (double& cost : costs_) cost *= kept;
}

std::optional<Determined> CostProfile::least() const {
  if (count_ < kFewest) return std::nullopt;
  const auto least = std::min_element(costs_.begin(), costs_.end());
  return values_.least([&](std::size_t i) { return costs_[i]; },
                       static_cast<std::size_t>(least - costs_.begin()), *least / count_);
}

}  // namespace sightline::pipeline
