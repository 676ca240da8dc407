#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

#include "sightline/scan/motion_noise.h"

namespace sightline::motion {

/// Covariance of Σ Gᵢ e(sᵢ), where e(s) is the error of the sensor's coordinates (x, y, θ) at the
/// ratio s of the sweep's time: cov(e(s), e(s')) = s s' drift + min(s, s') walk. A `drift` of -walk
/// leaves what a walk adds to the straight way to its end (a Brownian bridge).
template <int kRows>
class MotionSum {
 public:
  using Response = Eigen::Matrix<double, kRows, 3>;
  using Covariance = Eigen::Matrix<double, kRows, kRows>;

  void clear() { terms_.clear(); }
  void add(double time_ratio, const Response& response) {
    terms_.push_back({time_ratio, response});
  }
  /// Covariance of the sum, in one pass over the terms from the latest to the earliest: the stretch
  /// of walk between two of them moves all that come after it.
  Covariance covariance(const scan::MotionNoise& noise);

 private:
  struct Term {
    double time_ratio;
    Response response;
  };
  std::vector<Term> terms_;
};

template <int kRows>
typename MotionSum<kRows>::Covariance MotionSum<kRows>::covariance(const scan::MotionNoise& noise) {
  const auto isLater = [](const Term& a, const Term& b) { return a.time_ratio > b.time_ratio; };
  if (!std::is_sorted(terms_.begin(), terms_.end(), isLater)) {
    std::sort(terms_.begin(), terms_.end(), isLater);
  }
  Response all = Response::Zero();
  Response by_time = Response::Zero();
  Covariance walked = Covariance::Zero();
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    all += terms_[i].response;
    by_time += terms_[i].time_ratio * terms_[i].response;
    const double before = i + 1 < terms_.size() ? terms_[i + 1].time_ratio : 0.0;
    walked += (terms_[i].time_ratio - before) * all * noise.walk * all.transpose();
  }
  return walked + by_time * noise.drift * by_time.transpose();
}

}  // namespace sightline::motion
