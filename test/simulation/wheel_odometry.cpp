#include "sightline/simulation/wheel_odometry.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace sightline::simulation {
namespace {

using geometry::Pose2;
using motion::OdometryNoise;

constexpr int kRuns = 1000;
constexpr double kSmall = 0.0125;  // m or rad, a step of the simulation

// Drives a piece of constant curvature in small steps; returns what the wheels say of it.
Pose2 drive(WheelOdometry& wheels, const Eigen::Vector3d& way) {
  const double length = std::max(std::abs(way[0]), std::abs(way[2]));
  const auto steps = static_cast<int>(std::ceil(length / kSmall));
  const Pose2 before = wheels.pose().mean;
  for (int i = 0; i < steps; ++i) wheels.advance(Pose2::exp(way / steps));
  return geometry::between(before, wheels.pose().mean);
}

// Mean of the normalised estimation error squared, over runs, of what a filter predicts of a drive
// in steps of 25 mm from the odometry, knowing the scale of the run.
double nees(const OdometryNoise& noise, const Eigen::Vector3d& step, int steps) {
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    WheelOdometry wheels(noise, static_cast<std::uint64_t>(run));
    geometry::UncertainPose2 predicted;
    Pose2 truth;
    for (int i = 0; i < steps; ++i) {
      const Pose2 measured = drive(wheels, step);
      predicted =
          geometry::compose(predicted, {motion::expectedStep(noise, measured, wheels.scale()),
                                        motion::stepCovariance(noise, measured)});
      truth = truth * Pose2::exp(step);
    }
    Eigen::Vector3d error = truth.coordinates() - predicted.mean.coordinates();
    error[2] = geometry::wrapAngle(error[2]);
    sum += error.dot(predicted.covariance.inverse() * error);
  }
  return sum / kRuns;
}

TEST(WheelOdometryStatistics, ErrsAsTheModelOfTheFilterSaysWhenDriving) {
  const OdometryNoise noise;
  EXPECT_NEAR(nees(noise, {0.025, 0.0, 0.0}, 80), 3.0, 0.2) << "straight";
  EXPECT_NEAR(nees(noise, {0.025, 0.0, 0.02}, 80), 3.0, 0.2) << "in a curve";
}

TEST(WheelOdometryStatistics, ErrsAsTheModelOfTheFilterSaysWhenTurning) {
  OdometryNoise noise;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    WheelOdometry wheels(noise, static_cast<std::uint64_t>(run));
    const Pose2 measured = drive(wheels, {0.0, 0.0, 1.5});
    const double error = 1.5 - motion::expectedStep(noise, measured, wheels.scale()).theta();
    sum += error * error / motion::stepCovariance(noise, measured)(2, 2);
    EXPECT_EQ(measured.translation().norm(), 0.0);
  }
  EXPECT_NEAR(sum / kRuns, 1.0, 0.1);
}

TEST(WheelOdometry, ScaleIsDrawnOnceARunAboutItsMean) {
  const OdometryNoise noise;
  double sum = 0.0;
  double squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const double scale = WheelOdometry(noise, static_cast<std::uint64_t>(run)).scale();
    sum += scale;
    squares += (scale - noise.scale_mean) * (scale - noise.scale_mean);
  }
  EXPECT_NEAR(sum / kRuns, 1.006, 0.001);
  EXPECT_NEAR(std::sqrt(squares / kRuns), 0.01, 0.0006);
}

TEST(WheelOdometry, WithoutNoiseOnlyScaleAndBiasesRemain) {
  OdometryNoise noise;
  noise.scale_sigma = noise.distance_sigma = noise.lateral_sigma = 0.0;
  noise.heading_sigma_per_metre = noise.steering_sigma = 0.0;
  WheelOdometry wheels(noise, 1);
  drive(wheels, {10.06, 0.0, 0.0});
  EXPECT_NEAR(wheels.pose().mean.theta(), -noise.heading_bias_per_metre * 10.0 / 1.001, 1e-9)
      << "the true heading stayed, the wheels took out a drift that they expect";
  WheelOdometry turning(noise, 1);
  EXPECT_NEAR(drive(turning, {0.0, 0.0, 2.0}).theta(), 2.0 / 1.001, 1e-9);
}

// The reported covariance holds for the odometry as it is published, if it has no biases.
TEST(WheelOdometryStatistics, ReportedCovarianceCoversTheErrorOfTheSum) {
  OdometryNoise noise;
  noise.scale_mean = 1.0;
  noise.heading_bias_per_metre = noise.steering_bias = 0.0;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    WheelOdometry wheels(noise, static_cast<std::uint64_t>(run));
    drive(wheels, {1.5, 0.0, 0.0});
    drive(wheels, {1.0, 0.0, 1.2});
    const Pose2 truth = Pose2(1.5, 0.0, 0.0) * Pose2::exp({1.0, 0.0, 1.2});
    Eigen::Vector3d error = wheels.pose().mean.coordinates() - truth.coordinates();
    error[2] = geometry::wrapAngle(error[2]);
    sum += error.dot(wheels.pose().covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / kRuns, 3.0, 0.2);
}

TEST(WheelOdometry, StandingStillReportsNothing) {
  WheelOdometry wheels({}, 1);
  for (int i = 0; i < 100; ++i) wheels.advance({});
  EXPECT_EQ(wheels.pose().mean.coordinates(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(wheels.pose().covariance.isZero());
}

// Mean NEES of the twist against the true mean velocity, scale and biases taken out: 3 expected.
TEST(WheelOdometry, TwistErrsAsItsCovarianceSays) {
  OdometryNoise noise;
  noise.scale_mean = 1.0;
  noise.scale_sigma = 1e-9;
  noise.heading_bias_per_metre = noise.steering_bias = 0.0;
  const Eigen::Vector3d velocity(0.5, 0.0, 0.3);  // m/s, rad/s
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    WheelOdometry wheels(noise, static_cast<std::uint64_t>(run));
    for (int i = 0; i < 40; ++i) wheels.advance(Pose2::exp(0.005 * velocity));
    wheels.beginInterval();
    for (int i = 0; i < 4; ++i) wheels.advance(Pose2::exp(0.005 * velocity));
    const auto twist = wheels.twist(0.02);
    const Eigen::Vector3d error = twist.mean - velocity;
    sum += error.dot(twist.covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / kRuns, 3.0, 4.0 * std::sqrt(6.0 / kRuns));
}

}  // namespace
}  // namespace sightline::simulation
