#include "sightline/pipeline/delay_regression.h"

#include <algorithm>
#include <cmath>

namespace sightline::pipeline {

namespace {

constexpr struct {
  double fewest = 20.0;        // turns that tell something
  double outlier = 3.0;        // sigmas at which a turn counts half
  double least_sigma = 0.002;  // of a turn [rad]
} kDelay;

}  // namespace

void DelayRegression::Sums::add(double weight_of, double by_odometry, double by_scans) {
  weight += weight_of;
  odometry += weight_of * by_odometry;
  scans += weight_of * by_scans;
  odometry_squared += weight_of * by_odometry * by_odometry;
  product += weight_of * by_odometry * by_scans;
}

double DelayRegression::Sums::slope() const {
  const double spread = odometry_squared - odometry * odometry / weight;
  return spread > 0.0 ? (product - odometry * scans / weight) / spread : 0.0;
}

double DelayRegression::Sums::rest(double scans_squared) const {
  const double spread = scans_squared - scans * scans / weight;
  return spread - slope() * (product - odometry * scans / weight);
}

DelayRegression::DelayRegression(const EvenValues& delays)
    : delays_(delays), sums_(delays.size()), best_(sums_.size() / 2) {}

// By the difference from what the best delay so far makes one expect: wheels slip.
double DelayRegression::weightOf(const std::vector<double>& by_odometry, double by_scans) const {
  const Sums& sums = sums_[best_];
  if (sums.weight < kDelay.fewest) return 1.0;
  const double slope = sums.slope();
  const double expected =
      sums.scans / sums.weight + slope * (by_odometry[best_] - sums.odometry / sums.weight);
  const double variance =
      std::max(kDelay.least_sigma * kDelay.least_sigma, sums.rest(scans_squared_) / sums.weight);
  const double off = by_scans - expected;
  return 1.0 / (1.0 + off * off / (kDelay.outlier * kDelay.outlier * variance));
}

void DelayRegression::add(const std::vector<double>& by_odometry, double by_scans) {
  const double weight = weightOf(by_odometry, by_scans);
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].add(weight, by_odometry[i], by_scans);
  scans_squared_ += weight * by_scans * by_scans;
  const auto is_less = [&](const Sums& a, const Sums& b) {
    return a.rest(scans_squared_) < b.rest(scans_squared_);
  };
  best_ = static_cast<std::size_t>(std::min_element(sums_.begin(), sums_.end(), is_less) -
                                   sums_.begin());
}

void DelayRegression::fade(double kept) {
  for (Sums& sums : sums_) {
    for (double* sum :
         {&sums.weight, &sums.odometry, &sums.scans, &sums.odometry_squared, &sums.product}) {
      *sum *= kept;
    }
  }
  scans_squared_ *= kept;
}

std::optional<Determined> DelayRegression::delay() const {
  if (sums_[best_].weight < kDelay.fewest) return {};
  const auto rest = [&](std::size_t i) { return sums_[i].rest(scans_squared_); };
  return delays_.least(rest, best_, rest(best_) / (sums_[best_].weight - 3.0));
}

}  // namespace sightline::pipeline
