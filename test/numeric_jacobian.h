#pragma once

#include <Eigen/Core>

namespace sightline::test {

/// Jacobian of a function between vectors by central differences. `difference(a, b)` is a − b in
/// the space of the results, where that is not a vector space.
template <int kRows, int kCols, class Function, class Difference>
Eigen::Matrix<double, kRows, kCols> numericJacobian(const Function& function,
                                                    const Eigen::Matrix<double, kCols, 1>& at,
                                                    const Difference& difference,
                                                    double step = 1e-6) {
  Eigen::Matrix<double, kRows, kCols> jacobian;
  for (int i = 0; i < kCols; ++i) {
    Eigen::Matrix<double, kCols, 1> ahead = at;
    Eigen::Matrix<double, kCols, 1> behind = at;
    ahead[i] += step;
    behind[i] -= step;
    jacobian.col(i) = difference(function(ahead), function(behind)) / (2.0 * step);
  }
  return jacobian;
}

template <int kRows, int kCols, class Function>
Eigen::Matrix<double, kRows, kCols> numericJacobian(const Function& function,
                                                    const Eigen::Matrix<double, kCols, 1>& at) {
  using Result = Eigen::Matrix<double, kRows, 1>;
  return numericJacobian<kRows, kCols>(
      function, at, [](const Result& a, const Result& b) -> Result { return a - b; });
}

}  // namespace sightline::test
