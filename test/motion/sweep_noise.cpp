#include "sightline/motion/sweep_noise.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "numeric_jacobian.h"
#include "sightline/motion/sensor_path.h"

namespace sightline::motion {
namespace {

using geometry::Pose2;

TEST(SweepNoise, JacobianByTheTwistOfTheStart) {
  const Pose2 motion(0.4, -0.2, 0.7);
  const auto moved = [&](const Eigen::Vector3d& twist) -> Eigen::Vector3d {
    return (Pose2::exp(twist) * motion).coordinates();
  };
  const auto numeric = test::numericJacobian<3, 3>(moved, Eigen::Vector3d(Eigen::Vector3d::Zero()));
  EXPECT_LT((coordinatesByStartTwist(motion) - numeric).norm(), 1e-8);
}

TEST(SweepNoise, IsThatOfManySensorsOnCarriersThatErr) {
  const OdometryNoise noise;
  const Pose2 T_base_sensor(0.5, -0.3, 1.2);
  const Pose2 motion(0.3, 0.02, 0.4);
  const scan::MotionNoise claimed = sweepNoise(noise, motion, T_base_sensor, 0.1);
  test::Gauss gauss(5);
  test::Moments<3> moments;
  for (int i = 0; i < 40000; ++i) {
    const Pose2 truth(motion.coordinates() + gauss(stepCovariance(noise, motion)));
    moments.add((T_base_sensor.inverse() * truth * T_base_sensor).coordinates());
  }
  EXPECT_LT(test::relativeError<3>(moments.covariance(), claimed.drift + claimed.walk), 0.03);
  EXPECT_EQ(claimed.jitter, 0.0);
}

// Steps of independent errors, of constant velocity each: the variance about the straight way to
// the end, averaged over the sweep.
TEST(SweepNoise, StraysFromItsEndAsStepsDo) {
  const auto claimedStray = [](double stretches) {
    const auto noise = sweepNoise({}, {0.3, 0.0, 0.0}, {}, stretches * kStretch);
    const double all = noise.drift(0, 0) + noise.walk(0, 0);
    return noise.walk(0, 0) / all / 6.0;  // s (1 - s), averaged
  };
  test::Gauss gauss(6);
  for (const int stretches : {1, 2, 5}) {
    double square = 0.0;
    constexpr int kDraws = 20000;
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<double> way{0.0};
      for (int i = 0; i < stretches; ++i) way.push_back(way.back() + gauss(1.0));
      const double ratio = gauss.uniform(0.0, 1.0);
      const double place = ratio * stretches;
      const auto before = std::min(static_cast<std::size_t>(place), way.size() - 2);
      const double share = place - static_cast<double>(before);
      const double here = (1.0 - share) * way[before] + share * way[before + 1];
      const double stray = here - ratio * way.back();
      square += stray * stray / stretches / kDraws;
    }
    EXPECT_NEAR(square, claimedStray(stretches), 0.004) << stretches;
  }
}

TEST(SweepNoise, ACarrierThatStandsLeavesNothingUnknown) {
  EXPECT_TRUE(sweepNoise({}, {}, {0.5, -0.3, 1.2}, 0.1).isZero());
}

}  // namespace
}  // namespace sightline::motion
