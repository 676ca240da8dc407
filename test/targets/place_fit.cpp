#include "sightline/targets/place_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "monte_carlo.h"

namespace sightline::targets {
namespace {

using geometry::Pose2;

// A robot circles targets that are far apart, and sees each displaced.
double placeSigmaOf(double displaced, double sigma) {
  test::Gauss gauss(5);
  PlaceLooks robot;
  robot.errors.sigma = robot.labelling.sigma = sigma;
  robot.labelling.field_of_view = {-geometry::kPi, geometry::kPi};
  std::vector<Eigen::Vector2d> targets;
  for (int target = 0; target < 40; ++target) {
    targets.emplace_back(100.0 * target, 2.0);
    const Eigen::Vector2d seen =
        targets.back() + Eigen::Vector2d(gauss(displaced), gauss(displaced));
    for (int i = 0; i < 200; ++i) {
      KnownLook look;
      const double angle = 0.1 * i;
      const double range = i % 2 == 0 ? 1.0 : 2.0;
      look.T_map_sensor =
          Pose2(targets.back() + range * Eigen::Vector2d(std::cos(angle), std::sin(angle)), angle);
      look.bearings = {polarOf(look.T_map_sensor.inverse() * seen).bearing + gauss(sigma)};
      robot.looks.push_back(look);
    }
  }
  PlaceFit fit(targets);
  fit.add(robot);
  return fit.sigma();
}

TEST(PlaceFit, FindsHowFarTargetsAreDisplaced) {
  EXPECT_NEAR(placeSigmaOf(0.03, 0.02), 0.03, 0.006);
}

// Most of the bearings from nearby lie beyond the gate about the known place.
TEST(PlaceFit, FindsTargetsThatAreFartherOffThanTheGate) {
  EXPECT_NEAR(placeSigmaOf(0.03, 0.008), 0.03, 0.006);
}

TEST(PlaceFit, TakesNoiseForNoDisplacement) {
  EXPECT_LT(placeSigmaOf(0.0, 0.02), 0.002);
  EXPECT_EQ(PlaceFit({{1.0, 2.0}}).sigma(), 0.0);
}

}  // namespace
}  // namespace sightline::targets
