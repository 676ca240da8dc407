#include "sightline/tracking/pose_filter.h"

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "numeric_jacobian.h"
#include "sightline/motion/sweep_noise.h"

namespace sightline::tracking {
namespace {

using geometry::PolarLine;
using geometry::Pose2;
using geometry::UncertainPose2;
using Motion = LineBySweepError;

// The part of the tracker's settings that the filter takes.
struct Settings {
  motion::OdometryNoise odometry = motion::OdometryNoise::unmeasured();
};

const UncertainPose2 kStart{{1.0, 2.0, 0.7}, Eigen::Vector3d(0.01, 0.02, 0.001).asDiagonal()};

PolarLine lineOf(double rho, double phi, double rho_sigma = 0.0, double phi_sigma = 0.0) {
  PolarLine line{rho, phi, Eigen::Matrix2d::Zero()};
  line.covariance.diagonal() << rho_sigma * rho_sigma, phi_sigma * phi_sigma;
  return line;
}

TEST(PoseFilter, PredictionFollowsTheStepThroughTheScale) {
  Settings config;
  config.odometry.scale_mean = 1.1;
  PoseFilter filter(config.odometry, kStart);
  filter.predict(config.odometry, {1.0, 0.0, 0.2});
  const Pose2 expected = kStart.mean * Pose2(1.1, 0.0, 0.2);
  EXPECT_LT((filter.pose().mean.coordinates() - expected.coordinates()).norm(), 1e-12);
}

TEST(PoseFilter, PredictedCovarianceIsThatOfManyRobots) {
  Settings config;
  config.odometry.heading_sigma_per_metre = 0.03;
  const Pose2 step(0.8, 0.1, 0.3);
  PoseFilter filter(config.odometry, kStart);
  filter.predict(config.odometry, step);

  test::Gauss gauss(7);
  test::Moments<4> moments;
  for (int i = 0; i < 40000; ++i) {
    const Pose2 start(kStart.mean.coordinates() + gauss(kStart.covariance));
    const double scale = config.odometry.scale_mean + gauss(config.odometry.scale_sigma);
    const Pose2 moved = motion::expectedStep(config.odometry, step, scale);
    const Eigen::Matrix3d noise = motion::stepCovariance(config.odometry, moved);
    const Pose2 end = start * Pose2(moved.coordinates() + gauss(noise));
    Eigen::Vector4d state;
    state << end.coordinates(), scale;
    moments.add(state);
  }
  EXPECT_LT(test::relativeError<4>(moments.covariance(), filter.covariance()), 0.03);
}

TEST(PoseFilter, InnovationJacobianIsTheDerivativeOfThePrediction) {
  const Settings config;
  for (const double phi : {-2.5, -0.4, 0.9, 3.0}) {
    const PolarLine wall = lineOf(3.0, phi);
    const PolarLine measured = geometry::transform(kStart.mean.inverse(), wall);
    const auto value = [&](const Eigen::Vector3d& coordinates) -> Eigen::Vector2d {
      // The innovation is measured less predicted.
      return -PoseFilter(config.odometry, {Pose2(coordinates), kStart.covariance})
                  .innovation(measured, wall, Motion::Zero())
                  .value;
    };
    const auto numeric =
        test::numericJacobian<2, 3>(value, Eigen::Vector3d(kStart.mean.coordinates()));
    const auto analytic =
        PoseFilter(config.odometry, kStart).innovation(measured, wall, Motion::Zero()).jacobian;
    EXPECT_LT((analytic.leftCols<3>() - numeric).norm(), 1e-6) << phi;
    EXPECT_TRUE(analytic.col(3).isZero()) << "a line says nothing of the scale directly";
  }
}

TEST(PoseFilter, LinesCorrectThePoseConsistently) {
  // Two walls, 2000 robots: the mean NEES of a pose is its number of coordinates.
  const Settings config;
  const PolarLine walls[] = {lineOf(4.0, 0.1), lineOf(3.0, 1.8)};
  test::Gauss gauss(3);
  double sum = 0.0;
  constexpr int kRobots = 2000;
  for (int i = 0; i < kRobots; ++i) {
    const Pose2 truth(kStart.mean.coordinates() + gauss(kStart.covariance));
    PoseFilter filter(config.odometry, kStart);
    for (const PolarLine& wall : walls) {
      PolarLine measured = geometry::transform(truth.inverse(), wall);
      measured.rho += gauss(0.02);
      measured.phi += gauss(0.01);
      measured.covariance = lineOf(0, 0, 0.02, 0.01).covariance;
      filter.update(filter.innovation(measured, wall, Motion::Zero()));
    }
    const Eigen::Vector3d error = filter.pose().mean.coordinates() - truth.coordinates();
    sum += test::normalisedSquare<3>(error, filter.pose().covariance);
  }
  EXPECT_NEAR(sum / kRobots, 3.0, 0.25);
}

TEST(PoseFilter, LearnsTheScaleFromTheWayBetweenTwoWalls) {
  Settings config;
  config.odometry.scale_sigma = 0.05;
  const double true_scale = 1.03;
  const PolarLine wall = lineOf(30.0, 0.0);
  PoseFilter filter(config.odometry, {{0.0, 0.0, 0.0}, Eigen::Matrix3d::Identity() * 1e-4});
  Pose2 truth;
  for (int i = 0; i < 40; ++i) {
    filter.predict(config.odometry, {0.5, 0.0, 0.0});
    truth = truth * Pose2(0.5 * true_scale, 0.0, 0.0);
    PolarLine measured = geometry::transform(truth.inverse(), wall);
    measured.covariance = lineOf(0, 0, 0.005, 0.002).covariance;
    filter.update(filter.innovation(measured, wall, Motion::Zero()));
  }
  EXPECT_NEAR(filter.scale(), true_scale, 3.0 * filter.scaleSigma());
  EXPECT_LT(filter.scaleSigma(), 0.01);
}

TEST(PoseFilter, SharedMotionOfASweepIsNotAveragedAway) {
  // A hundred walls that all suffer the same unknown motion do not know the pose better than that
  // motion allows.
  const Settings config;
  const Eigen::Matrix3d motion = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
  PoseFilter filter(config.odometry, kStart);
  filter.beginSweep({motion, Eigen::Matrix3d::Zero()});
  const PolarLine wall = lineOf(4.0, 0.0, 0.01, 0.005);
  Motion follows = Motion::Zero();
  follows.rightCols<3>() << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  for (int i = 0; i < 100; ++i) {
    PolarLine measured = geometry::transform(filter.pose().mean.inverse(), wall);
    measured.covariance = wall.covariance;
    filter.update(filter.innovation(measured, wall, follows));
  }
  const Eigen::Vector2d across = wall.normal();
  const double variance = across.dot(filter.pose().covariance.topLeftCorner<2, 2>() * across);
  EXPECT_GT(variance, 0.5e-4);
}

// The motion that a scan shows in its sweep holds for the first half of the step that follows; the
// other half errs anew.
TEST(PoseFilter, PredictionIsConsistentWithWhatTheSweepToldOfTheMotion) {
  motion::OdometryNoise odometry = motion::OdometryNoise::unmeasured();
  odometry.scale_sigma = 0.0;
  const Pose2 step(0.6, 0.05, 0.3);
  const Pose2 half = geometry::interpolate({}, step, 0.5);
  const Eigen::Matrix3d half_noise = motion::stepCovariance(odometry, half);
  const Eigen::Matrix3d to_twist = motion::coordinatesByStartTwist(half).inverse();
  const Eigen::Matrix3d sweep = to_twist * half_noise * to_twist.transpose();
  const PolarLine walls[] = {lineOf(4.0, 0.1), lineOf(3.0, 1.8)};
  Motion follows = Motion::Zero();
  follows.rightCols<3>() << 0.5, 0.2, 1.0, 0.0, 0.0, 0.5;
  test::Gauss gauss(6);
  double sum = 0.0;
  constexpr int kRobots = 4000;
  for (int i = 0; i < kRobots; ++i) {
    const Eigen::Vector3d motion_error = gauss(sweep);
    const Pose2 truth(kStart.mean.coordinates() + gauss(kStart.covariance));
    PoseFilter filter(odometry, kStart);
    filter.beginSweep({sweep, Eigen::Matrix3d::Zero()});
    for (const PolarLine& wall : walls) {
      PolarLine measured = geometry::transform(truth.inverse(), wall);
      const Eigen::Vector2d moved = follows.rightCols<3>() * motion_error;
      measured.rho += gauss(0.002) + moved[0];
      measured.phi += gauss(0.001) + moved[1];
      measured.covariance = lineOf(0, 0, 0.002, 0.001).covariance;
      filter.update(filter.innovation(measured, wall, follows));
    }
    filter.predict(odometry, step);
    const Pose2 rest(half.coordinates() + gauss(half_noise));
    const Pose2 end = truth * Pose2::exp(-motion_error) * half * rest;
    const Eigen::Vector3d error = filter.pose().mean.coordinates() - end.coordinates();
    sum += test::normalisedSquare<3>(error, filter.pose().covariance);
  }
  EXPECT_NEAR(sum / kRobots, 3.0, 0.15);
}

}  // namespace
}  // namespace sightline::tracking
