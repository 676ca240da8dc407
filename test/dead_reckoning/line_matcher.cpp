#include "sightline/dead_reckoning/line_matcher.h"

#include <gtest/gtest.h>

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

TEST(LineResidual, JacobianIsTheNumericDifference) {
  const Surfel surfel{{2.0, 1.0}, {-0.6, 0.8}, 0.0, 0.05};
  const Eigen::Vector2d point(1.3, -0.4);
  const Pose2 pose(0.2, 0.5, 0.7);
  const auto at = [&](const Pose2& T_odom_base) {
    return lineResidual(T_odom_base.translation(), T_odom_base.rotation() * point, surfel);
  };
  EXPECT_NEAR(at(pose).value, surfel.normal.dot(pose * point - surfel.position), 1e-12);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    const double ahead = at(Pose2(pose.coordinates() + step)).value;
    const double back = at(Pose2(pose.coordinates() - step)).value;
    EXPECT_NEAR((ahead - back) / (2.0 * kStep), at(pose).jacobian[i], 1e-8);
  }
}

}  // namespace
}  // namespace sightline::dead_reckoning
