#pragma once

#include <cmath>
#include <random>

#include <Eigen/Core>

namespace sightline::test {

/// What the decompositions of monte_carlo.cpp take: of any size up to this, so that they are
/// compiled once.
constexpr int kMostRows = 8;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1>;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;

/// Seeded normal noise.
class Gauss {
 public:
  explicit Gauss(unsigned seed) : engine_(seed) {}

  double operator()(double sigma = 1.0) { return sigma * normal_(engine_); }

  /// Draws from a given covariance, which may be semidefinite.
  template <int kSize>
  Eigen::Matrix<double, kSize, 1> operator()(
      const Eigen::Matrix<double, kSize, kSize>& covariance) {
    static_assert(kSize <= kMostRows);
    return correlated(covariance);
  }

  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine_);
  }

 private:
  SmallVector correlated(const SmallMatrix& covariance);

  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// Mean and covariance of samples.
template <int kSize>
class Moments {
 public:
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  void add(const Vector& sample) {
    ++count_;
    const Vector before = sample - mean_;
    mean_ += before / count_;
    scatter_ += before * (sample - mean_).transpose();
  }
  Vector mean() const { return mean_; }
  Matrix covariance() const { return scatter_ / (count_ - 1.0); }
  double count() const { return count_; }

 private:
  double count_ = 0.0;
  Vector mean_ = Vector::Zero();
  Matrix scatter_ = Matrix::Zero();
};

/// Largest relative error of `sampled`, each entry measured by the standard deviations that belong
/// to it: 0 where they are alike, whatever the units.
template <int kSize>
double relativeError(const Eigen::Matrix<double, kSize, kSize>& sampled,
                     const Eigen::Matrix<double, kSize, kSize>& expected) {
  const Eigen::Matrix<double, kSize, 1> sigma = expected.diagonal().cwiseSqrt();
  return (sampled - expected).cwiseQuotient(sigma * sigma.transpose()).cwiseAbs().maxCoeff();
}

double normalisedSquareOf(const SmallVector& error, const SmallMatrix& covariance);

/// Squared error in units of the covariance (NEES).
template <int kSize>
double normalisedSquare(const Eigen::Matrix<double, kSize, 1>& error,
                        const Eigen::Matrix<double, kSize, kSize>& covariance) {
  static_assert(kSize <= kMostRows);
  return normalisedSquareOf(error, covariance);
}

/// Counts that are to be expected of trials.
struct CountRange {
  int least;
  int most;
};

/// How many of independent trials succeed, each with the same probability, but for the cases in
/// either tail of the binomial distribution.
inline CountRange binomialRange(int trials, double probability, double tail = 1e-3) {
  const auto chanceOf = [&](int successes) {
    return std::exp(std::lgamma(trials + 1.0) - std::lgamma(successes + 1.0) -
                    std::lgamma(trials - successes + 1.0) + successes * std::log(probability) +
                    (trials - successes) * std::log1p(-probability));
  };
  CountRange range{0, trials};
  for (double below = chanceOf(0); below < tail; below += chanceOf(range.least)) ++range.least;
  for (double above = chanceOf(trials); above < tail; above += chanceOf(range.most)) --range.most;
  return range;
}

}  // namespace sightline::test
