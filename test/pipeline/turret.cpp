// A scanner on a turret under the room tracker, against the same scanner fixed to the robot.
#include <cmath>

#include <gtest/gtest.h>

#include "two_rooms.h"

namespace sightline {
namespace {

struct Errors {
  double rmse = 0.0;  // [m]
  double nees = 0.0;  // mean
};

Errors errorsAt(double turret_rate) {
  test::TwoRoomsScenario scenario;
  scenario.full_circle = true;
  scenario.turret_rate = turret_rate;
  double square = 0.0;
  Errors errors;
  std::size_t count = 0;
  for (const std::uint64_t seed : {1U, 2U}) {
    test::TwoRoomsDrive drive(scenario, seed, test::trackerConfig(), scan::NoiseKind::kConstant);
    for (const test::PoseSample& sample : drive.samples()) {
      square += sample.position_error * sample.position_error;
      errors.nees += sample.nees;
      ++count;
    }
  }
  errors.rmse = std::sqrt(square / static_cast<double>(count));
  errors.nees /= static_cast<double>(count);
  return errors;
}

TEST(TurretStatistics, TracksAsWellAsAFixedScanner) {
  const Errors fixed = errorsAt(0.0);
  const Errors turning = errorsAt(geometry::radians(90.0));
  EXPECT_NEAR(turning.rmse, fixed.rmse, 0.1 * fixed.rmse);
  EXPECT_GT(turning.nees, 2.5);
  EXPECT_LT(turning.nees, 3.5);
}

}  // namespace
}  // namespace sightline
