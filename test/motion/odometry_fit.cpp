#include "sightline/motion/odometry_fit.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace sightline::motion {
namespace {

using geometry::Pose2;

constexpr double kPoseSigma = 0.003;      // of the pose that the wheels are compared with [m]
constexpr double kHeadingSigma = 0.0005;  // [rad]

// A robot whose wheels err as they are told to.
class FittedDrive {
 public:
  explicit FittedDrive(const OdometryNoise& noise, unsigned seed = 1)
      : noise_(noise), random_(seed) {
    report();
  }

  void go(const Pose2& reported, int steps) {
    for (int i = 0; i < steps; ++i) {
      const Eigen::Matrix3d covariance = stepCovariance(noise_, reported);
      const Eigen::Vector3d sigma = covariance.diagonal().cwiseSqrt();
      const Pose2 slip(sigma[0] * normal_(random_), sigma[1] * normal_(random_),
                       sigma[2] * normal_(random_));
      T_odom_base_ = T_odom_base_ * reported;
      T_map_base_ = T_map_base_ * expectedStep(noise_, reported, noise_.scale_mean) * slip;
      report();
    }
  }

  void report() {
    const Pose2 off(kPoseSigma * normal_(random_), kPoseSigma * normal_(random_),
                    kHeadingSigma * normal_(random_));
    const Eigen::Vector3d sigma(kPoseSigma, kPoseSigma, kHeadingSigma);
    legs.add(T_odom_base_, {T_map_base_ * off, sigma.cwiseAbs2().asDiagonal()});
  }

  OdometryLegs legs;

 private:
  OdometryNoise noise_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose2 T_odom_base_{1.0, 2.0, 0.5};
  Pose2 T_map_base_{-3.0, 0.0, 2.0};
};

OdometryNoise wheels() {
  OdometryNoise noise = OdometryNoise::unmeasured();
  noise.scale_mean = 1.03;
  noise.steering_bias = -0.02;
  noise.heading_bias_per_metre = 0.01;
  noise.distance_sigma = 0.01;
  noise.lateral_sigma = 0.004;
  noise.heading_sigma_per_metre = 0.008;
  noise.steering_sigma = 0.01;
  return noise;
}

TEST(OdometryFit, FindsTheErrorsOfTheWheels) {
  FittedDrive drive(wheels());
  for (int lap = 0; lap < 12; ++lap) {
    drive.go({0.04, 0.0, 0.0}, 100);
    drive.go({0.0, 0.0, lap % 3 == 0 ? -0.05 : 0.05}, 40);
  }
  const OdometryFit fit = fitOdometry(drive.legs.legs());
  ASSERT_TRUE(fit.scale.is_known && fit.steering.is_known && fit.heading.is_known);
  EXPECT_NEAR(fit.scale.value, 1.03, 3.0 * fit.scale.sigma);
  EXPECT_NEAR(fit.steering.value, -0.02, 3.0 * fit.steering.sigma);
  EXPECT_NEAR(fit.heading.value, 0.01, 3.0 * fit.heading.sigma);
  EXPECT_LT(fit.scale.sigma, 0.003);
  EXPECT_NEAR(fit.noise.distance_sigma, 0.01, 0.003);
  EXPECT_NEAR(fit.noise.heading_sigma_per_metre, 0.008, 0.003);
  EXPECT_EQ(fit.noise.scale_mean, fit.scale.value);
}

TEST(OdometryFit, SaysWhatADriveDoesNotTell) {
  FittedDrive straight(wheels());
  straight.go({0.04, 0.0, 0.0}, 500);
  const OdometryFit along = fitOdometry(straight.legs.legs());
  EXPECT_TRUE(along.scale.is_known);
  EXPECT_FALSE(along.steering.is_known);
  EXPECT_EQ(along.noise.steering_bias, OdometryNoise::unmeasured().steering_bias);

  FittedDrive turning(wheels());
  turning.go({0.0, 0.0, 0.05}, 400);
  const OdometryFit round = fitOdometry(turning.legs.legs());
  EXPECT_FALSE(round.scale.is_known);
  EXPECT_TRUE(round.steering.is_known);
  EXPECT_EQ(round.noise.scale_sigma, OdometryNoise::unmeasured().scale_sigma);
}

TEST(OdometryFit, NothingIsKnownOfNoDrive) {
  const OdometryFit fit = fitOdometry({});
  EXPECT_EQ(fit.legs, 0U);
  EXPECT_FALSE(fit.scale.is_known);
  EXPECT_EQ(fit.noise.scale_mean, OdometryNoise::unmeasured().scale_mean);
}

TEST(OdometryLegs, AreCutByLengthAndTurn) {
  OdometryLegs legs;
  for (int i = 0; i <= 20; ++i) legs.add({0.1 * i, 0.0, 0.0}, {{0.1 * i, 0.0, 0.0}, {}});
  EXPECT_EQ(legs.legs().size(), 4U);
  for (int i = 1; i <= 10; ++i) legs.add({2.0, 0.0, 0.1 * i}, {{2.0, 0.0, 0.1 * i}, {}});
  EXPECT_EQ(legs.legs().size(), 6U);
}

TEST(OdometryLegs, AnInterruptedLegIsNotUsed) {
  OdometryLegs legs;
  for (int i = 0; i < 4; ++i) legs.add({0.1 * i, 0.0, 0.0}, {});
  legs.interrupt();
  legs.add({9.0, 0.0, 0.0}, {});
  for (int i = 1; i < 5; ++i) legs.add({9.0 + 0.1 * i, 0.0, 0.0}, {});
  EXPECT_TRUE(legs.legs().empty());
}

}  // namespace
}  // namespace sightline::motion
