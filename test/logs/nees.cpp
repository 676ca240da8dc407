#include "sightline/logs/nees.h"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

namespace sightline::logs {
namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

Eigen::Matrix3d exampleCovariance() {
  Eigen::Matrix3d factor;
  factor << 0.2, 0.0, 0.0, 0.05, 0.1, 0.0, -0.02, 0.01, 0.03;
  return factor * factor.transpose();
}

TEST(Nees, IsTheDimensionOnAverageWhereTheCovarianceIsRight) {
  const Eigen::Matrix3d covariance = exampleCovariance();
  const Eigen::Matrix3d factor = covariance.llt().matrixL();
  const Pose2 truth(1.0, 2.0, 3.1);  // its estimates lie on both sides of ±π
  std::mt19937 random(20261122);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  constexpr int kRuns = 20000;
  for (int i = 0; i < kRuns; ++i) {
    const Eigen::Vector3d error =
        factor * Eigen::Vector3d(normal(random), normal(random), normal(random));
    sum += nees(UncertainPose2{Pose2(truth.coordinates() + error), covariance}, truth);
  }
  // The mean of that many chi-squares of 3 has a standard deviation of sqrt(6 / runs).
  EXPECT_NEAR(sum / kRuns, 3.0, 5.0 * std::sqrt(6.0 / kRuns));
}

TEST(Nees, CountsStandardDeviationsAlongAnAxis) {
  const Eigen::Vector2d error(0.3, 0.0);
  const Eigen::Matrix2d covariance = Eigen::Vector2d(0.01, 4.0).asDiagonal();
  EXPECT_NEAR(nees(error, covariance), 9.0, 1e-12);
}

TEST(Nees, RefusesWhatIsNoCovariance) {
  EXPECT_THROW(nees(Eigen::Vector2d(1, 1), Eigen::Matrix2d::Zero()), std::invalid_argument);
  EXPECT_THROW(nees(Eigen::Vector2d(1, 1), -Eigen::Matrix2d::Identity()), std::invalid_argument);
}

}  // namespace
}  // namespace sightline::logs
