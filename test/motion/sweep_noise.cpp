#include "sightline/motion/sweep_noise.h"

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "numeric_jacobian.h"

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
  const scan::MotionNoise claimed = sweepNoise(noise, motion, T_base_sensor);
  test::Gauss gauss(5);
  test::Moments<3> moments;
  for (int i = 0; i < 40000; ++i) {
    const Pose2 truth(motion.coordinates() + gauss(stepCovariance(noise, motion)));
    moments.add((T_base_sensor.inverse() * truth * T_base_sensor).coordinates());
  }
  EXPECT_LT(test::relativeError<3>(moments.covariance(), claimed.walk), 0.03);
  EXPECT_TRUE(claimed.drift.isZero(0.0));
  EXPECT_EQ(claimed.jitter, 0.0);
}

TEST(SweepNoise, ACarrierThatStandsLeavesNothingUnknown) {
  EXPECT_TRUE(sweepNoise({}, {}, {0.5, -0.3, 1.2}).isZero());
}

}  // namespace
}  // namespace sightline::motion
