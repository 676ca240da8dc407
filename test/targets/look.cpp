// Looks as filters weigh them: bearings without what the sensor makes of them, and their densities.
#include "sightline/targets/look.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bearing_looks.h"

namespace sightline::targets {
namespace {

TEST(Look, TakesOffWhatLatenessMakesOfTurning) {
  SensorModelConfig config;
  config.bearing.bias = 0.01;
  config.bearing.lag = 0.04;
  const SensorModel model(config);
  BearingSet set = test::lookFrom({}, {0.3});
  set.turn_rate = 0.5;
  EXPECT_NEAR(Look(set, model).bearing(0), 0.3 - 0.01 - 0.02, 1e-12);
}

TEST(Look, TakesOffWhatALensDoes) {
  SensorModelConfig config;
  config.bearing.distortion = DistortionConfig{{-0.5, 0.0, 0.5}, {0.02, 0.0, -0.04}};
  const SensorModel model(config);
  for (const double bearing : {-0.7, -0.3, 0.0, 0.2, 0.45, 1.0}) {
    const double measured = bearing + config.bearing.biasAt(bearing);
    const BearingSet set = test::lookFrom({}, {measured});
    EXPECT_NEAR(Look(set, model).bearing(0), bearing, 3e-4) << bearing;
    EXPECT_GT(model.likelihood(measured, Polar{2.0, bearing}),
              model.likelihood(measured + 0.01, Polar{2.0, bearing}));
  }
}

// Errors near zero are of the narrow Gaussian, far ones of the wide one; together they are one
// density with the standard deviation that the model says.
TEST(Look, HasTails) {
  constexpr double kStep = 2e-4;
  SensorModelConfig config;
  config.bearing.sigma = 0.01;
  config.bearing.tail = 1.6;
  const SensorModel model(config);
  std::vector<double> bearings;
  for (double bearing = -0.2; bearing < 0.2; bearing += kStep) bearings.push_back(bearing);
  const BearingSet set = test::lookFrom({}, bearings);
  const Look look(set, model);
  const Component component{1.0, {2.0, 0.0}, Eigen::Matrix2d::Zero()};
  const auto prediction = predictBearing(component, look.pose(), look.sigma());
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const double mass = kStep * look.likelihood(i, prediction);
    sum += mass;
    squares += mass * bearings[i] * bearings[i];
  }
  EXPECT_NEAR(sum, 1.0, 1e-3);
  EXPECT_NEAR(std::sqrt(squares), 0.016, 2e-4);
  const std::size_t middle = bearings.size() / 2;
  EXPECT_LT(look.innovation(middle, prediction).variance, 1.2e-4);
  EXPECT_GT(look.innovation(middle + 300, prediction).variance, 5.5e-4);
}

TEST(Look, ErrsMoreInTurnsIfStampsJitter) {
  SensorModelConfig config;
  config.bearing.sigma = 0.01;
  config.bearing.jitter = 0.03;
  const SensorModel model(config);
  BearingSet set = test::lookFrom({}, {0.3});
  EXPECT_NEAR(Look(set, model).sigma(), 0.01, 1e-12);
  set.turn_rate = 0.5;
  const Look turning(set, model);
  EXPECT_NEAR(turning.sigma(), std::hypot(0.01, 0.015), 1e-12);
  EXPECT_NEAR(turning.commonVariance(), 0.015 * 0.015, 1e-12);
}

// Half of what a component covers lies behind a wall.
TEST(Look, SeesOfAComponentWhatNoWallHides) {
  world::World world;
  world.add(world::WorldSegment{geometry::Segment{{2.0, -3.0}, {2.0, 3.0}}});
  const SensorModel model({}, std::make_shared<WorldSight>(world, 0.3));
  const BearingSet set = test::lookFrom({}, {});
  const Look look(set, model);
  Component component{1.0, {1.9, 0.0}, Eigen::Vector2d(0.25, 0.0001).asDiagonal()};
  const double wide = look.detection(component, polarOf(component.mean));
  component.covariance *= 1e-3;
  const double narrow = look.detection(component, polarOf(component.mean));
  EXPECT_NEAR(wide, 0.75 * narrow, 0.1 * narrow);
}

}  // namespace
}  // namespace sightline::targets
