#include "sightline/targets/place_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "monte_carlo.h"

namespace sightline::targets {
namespace {

using geometry::Pose2;

// A robot circles each target and sees it displaced.
double placeSigmaOf(double displaced, double sigma) {
  test::Gauss gauss(5);
  PlaceFit fit;
  ErrorFit errors;
  errors.sigma = sigma;
  const std::vector<Eigen::Vector2d> targets(40, Eigen::Vector2d(1.0, 2.0));
  for (std::size_t target = 0; target < targets.size(); ++target) {
    const Eigen::Vector2d offset(gauss(displaced), gauss(displaced));
    std::vector<KnownLook> looks;
    std::vector<Opportunity> labelled;
    for (int i = 0; i < 200; ++i) {
      KnownLook look;
      const double angle = 0.1 * i;
      look.T_map_sensor =
          Pose2(targets[target] + 2.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle)), angle);
      const auto bearing = [&](const Eigen::Vector2d& place) {
        return polarOf(look.T_map_sensor.inverse() * place).bearing;
      };
      const double error =
          geometry::wrapAngle(bearing(targets[target] + offset) - bearing(targets[target])) +
          gauss(sigma);
      labelled.push_back({looks.size(), target, {2.0, 0.0}, true, error});
      looks.push_back(look);
    }
    fit.add(looks, labelled, targets, errors, 1.0);
  }
  return fit.sigma();
}

TEST(PlaceFit, FindsHowFarTargetsAreDisplaced) {
  EXPECT_NEAR(placeSigmaOf(0.03, 0.02), 0.03, 0.006);
}

TEST(PlaceFit, TakesNoiseForNoDisplacement) {
  EXPECT_LT(placeSigmaOf(0.0, 0.02), 0.002);
  EXPECT_EQ(PlaceFit().sigma(), 0.0);
}

}  // namespace
}  // namespace sightline::targets
