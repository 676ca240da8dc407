#include "monte_carlo.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace sightline::test {

SmallVector Gauss::correlated(const SmallMatrix& covariance) {
  const auto factor = covariance.ldlt();
  SmallVector sample(covariance.rows());
  for (int i = 0; i < sample.size(); ++i)
    sample[i] = (*this)(std::sqrt(std::max(0.0, factor.vectorD()[i])));
  sample = factor.matrixL() * sample;
  return factor.transpositionsP().transpose() * sample;
}

double normalisedSquareOf(const SmallVector& error, const SmallMatrix& covariance) {
  return error.dot(covariance.ldlt().solve(error));
}

}  // namespace sightline::test
