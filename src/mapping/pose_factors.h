#pragma once

#include <cmath>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"

/// Residuals of the least squares over poses; a pose is its coordinates (x, y, θ).
namespace sightline::mapping {

template <class T>
T wrapped(const T& angle) {
  using std::floor;
  return angle -
         T(2.0 * geometry::kPi) * floor((angle + T(geometry::kPi)) / T(2.0 * geometry::kPi));
}

/// Difference between the step from a to b and an expected one, in the coordinates of the step.
template <class T>
Eigen::Matrix<T, 3, 1> stepDifference(const T* a, const T* b,
                                      const Eigen::Matrix<T, 3, 1>& expected) {
  using std::cos;
  using std::sin;
  const T c = cos(a[2]);
  const T s = sin(a[2]);
  const T dx = b[0] - a[0];
  const T dy = b[1] - a[1];
  return {c * dx + s * dy - expected[0], c * dy - s * dx - expected[1],
          wrapped(b[2] - a[2] - expected[2])};
}

/// A measured step, whitened.
class StepFactor {
 public:
  StepFactor(const geometry::Pose2& step, const Eigen::Matrix3d& root)
      : step_(step.coordinates()), root_(root) {}
  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    Eigen::Map<Eigen::Matrix<T, 3, 1>> out(residual);
    out = root_.cast<T>() * stepDifference<T>(a, b, step_.cast<T>());
    return true;
  }

 private:
  Eigen::Vector3d step_;
  Eigen::Matrix3d root_;
};

/// The same of a step by wheels, whose length is to be scaled, and which turn unnoticed by so much
/// a metre.
class WheelFactor {
 public:
  WheelFactor(const geometry::Pose2& step, const Eigen::Matrix3d& root)
      : step_(step.coordinates()), root_(root) {}
  template <class T>
  bool operator()(const T* a, const T* b, const T* scale, const T* turn, T* residual) const {
    const Eigen::Matrix<T, 3, 1> expected(scale[0] * step_[0], scale[0] * step_[1],
                                          step_[2] + turn[0] * step_.head<2>().norm());
    Eigen::Map<Eigen::Matrix<T, 3, 1>> out(residual);
    out = root_.cast<T>() * stepDifference<T>(a, b, expected);
    return true;
  }

 private:
  Eigen::Vector3d step_;
  Eigen::Matrix3d root_;
};

/// What is known of a number.
class PriorFactor {
 public:
  PriorFactor(double mean, double sigma) : mean_(mean), sigma_(sigma) {}
  template <class T>
  bool operator()(const T* value, T* residual) const {
    residual[0] = (value[0] - mean_) / sigma_;
    return true;
  }

 private:
  double mean_;
  double sigma_;
};

/// R with Rᵀ R = information, which may be singular.
Eigen::Matrix3d rootOf(const Eigen::Matrix3d& information);

}  // namespace sightline::mapping
