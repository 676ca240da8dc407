// Field, watch on the head and informative looks, each alone.
#include <cmath>

#include <gtest/gtest.h>

#include "sightline/gaze/head_watch.h"
#include "sightline/gaze/informative_gaze.h"
#include "sightline/gaze/sensor_field.h"
#include "sightline/gaze/wall_visibility.h"
#include "sightline/motion/sensor_head.h"

namespace sightline::gaze {
namespace {

using geometry::Pose2;

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(SensorField, AimPutsAPlaceInTheMiddle) {
  SensorField field;
  field.centre = 0.03;
  for (const Eigen::Vector2d& place :
       {Eigen::Vector2d(1.5, 0.4), Eigen::Vector2d(0.5, -1.2), Eigen::Vector2d(-0.3, 1.0)}) {
    const Eigen::Vector2d seen = field.T_mount_sensor(field.aimAt(place)).inverse() * place;
    EXPECT_NEAR(seen.y(), 0.0, 1e-12);
    EXPECT_GT(seen.x(), 0.0);
    EXPECT_TRUE(field.holds(place, field.aimAt(place)));
  }
}

TEST(SensorField, HoldsWhatIsInFieldAndReach) {
  const SensorField field;
  EXPECT_TRUE(field.holds({1.5, 0.0}, 0.0));
  EXPECT_FALSE(field.holds({1.5, 0.0}, 0.5));
  EXPECT_FALSE(field.holds({3.0, 0.0}, 0.0));
  EXPECT_FALSE(field.holds({0.2, 0.0}, 0.0));
  EXPECT_TRUE(std::isfinite(field.aimAt({0.0, 0.0})));
}

class HeadWatchTest : public testing::Test {
 protected:
  std::string faultAfter(int milliseconds) { return watch_.fault(milliseconds * kMillisecond); }
  HeadWatch watch_{motion::HeadLimits{}, 0.6};
};

TEST_F(HeadWatchTest, IsContentWithAHeadThatMoves) {
  watch_.command(1.0, 0);
  for (int i = 1; i <= 50; ++i) watch_.report(0.02 * i, 20 * i * kMillisecond);
  EXPECT_EQ(faultAfter(1000), "");
  // At its place it need not move.
  for (int i = 51; i <= 200; ++i) watch_.report(1.0, 20 * i * kMillisecond);
  EXPECT_EQ(faultAfter(4000), "");
}

TEST_F(HeadWatchTest, SaysWithinASecondThatAHeadIsStuck) {
  for (int i = 0; i < 10; ++i) watch_.report(0.1, 20 * i * kMillisecond);
  watch_.command(1.0, 200 * kMillisecond);
  for (int i = 10; i <= 45; ++i) watch_.report(0.1, 20 * i * kMillisecond);
  EXPECT_EQ(faultAfter(700), "");
  EXPECT_EQ(faultAfter(900), "the head is stuck");
}

TEST_F(HeadWatchTest, SaysWithinASecondThatAHeadDoesNotAnswer) {
  watch_.command(1.0, 0);
  EXPECT_EQ(faultAfter(500), "");
  EXPECT_EQ(faultAfter(700), "the head does not answer");
  watch_.restart(700 * kMillisecond);
  EXPECT_EQ(faultAfter(5000), "");
}

class InformativeGazeTest : public testing::Test {
 protected:
  InformativeGazeTest() {
    map_.addRectangle("room", {20.0, 4.0});
    place_.T_map_base = Pose2(8.6, 0.2, 0.3);
    place_.T_base_mount = Pose2(0.1, 0.05, 0.2);
  }
  double headingOf(const Look& look) const {
    return (place_.T_map_base * place_.T_base_mount).theta() + look.angle;
  }
  void know(double x, double y, double theta) {
    const InformConfig& inform = config_.inform;
    place_.uncertainty = PoseUncertainty(Eigen::Vector3d(x, y, theta).asDiagonal(),
                                         {inform.wall_position_sigma, inform.wall_direction_sigma});
  }

  GazeConfig config_;
  world::RoomMap map_;
  WallVisibility visibility_{20.0};
  LookingPlace place_;
};

// The distances of points on walls from the walls, by numerical derivatives of the pose.
TEST_F(InformativeGazeTest, LooksAtTheEndOfACorridorWhereTheWayAlongItIsUncertain) {
  know(0.25, 1e-5, 1e-5);
  const Look look = InformativeGaze(config_).choose(place_, map_, visibility_);
  EXPECT_TRUE(look.has_walls);
  EXPECT_LT(look.variance, 0.2);
  EXPECT_NEAR(headingOf(look), 0.0, 0.6);
}

TEST_F(InformativeGazeTest, LooksAtTheSideWhereTheWayAcrossIsUncertain) {
  know(1e-5, 0.25, 1e-5);
  const Look look = InformativeGaze(config_).choose(place_, map_, visibility_);
  EXPECT_GT(std::abs(headingOf(look)), 0.6);
}

TEST_F(InformativeGazeTest, SaysThatNoWallIsInReach) {
  world::RoomMap hall;
  hall.addRectangle("hall", {100.0, 100.0});
  const Look look = InformativeGaze(config_).choose(place_, hall, visibility_);
  EXPECT_FALSE(look.has_walls);
  EXPECT_EQ(look.angle, place_.head_angle);
}

TEST_F(InformativeGazeTest, TimeOfTheWayIsThatOfTheServo) {
  const InformativeGaze gaze(config_);
  motion::SensorHead head(config_.head);
  head.command({motion::HeadCommand::Mode::kPosition, 1.5, 0.0});
  double time = 0.0;
  while (std::abs(head.angle() - 1.5) > 0.01) {
    head.step(1e-3);
    time += 1e-3;
  }
  EXPECT_NEAR(gaze.travelTime(0.0, 1.5), time, 0.05);
  EXPECT_NEAR(gaze.travelTime(0.1, 0.1), 0.0, 1e-9);
}

// A screen in front of a wall.
TEST_F(InformativeGazeTest, LearnsWhatHidesAWall) {
  const auto geometry = scan::ScanGeometry::uniform(-0.3, 0.005, 121, 0.0, 0.1, 2.5);
  const Pose2 T_map_sensor(8.6, 0.0, 0.0);
  const world::RoomView view(map_, 0, T_map_sensor.translation(), world::RoomView::Doors::kOpen);
  const auto sighting = view.look({1.0, 0.0});
  ASSERT_TRUE(sighting);
  const double before = visibility_.at(*sighting);
  const scan::Scan scan(geometry, 0, std::vector<double>(121, 0.9));
  for (int i = 0; i < 5; ++i) {
    visibility_.take(mapBeams(scan, map_, 0, T_map_sensor), 0.1);
  }
  EXPECT_LT(visibility_.at(*sighting), 0.3);
  // It is forgotten again.
  visibility_.take({}, 200.0);
  EXPECT_NEAR(visibility_.at(*sighting), before, 0.01);
}

TEST(GazeConfig, RefusesARestBeyondTheLimits) {
  GazeConfig config;
  config.rest = 2.0;
  EXPECT_THROW(GazeControl{config}, config::Error);
  config.rest = 0.0;
  config.field.range_min = 3.0;
  EXPECT_THROW(GazeControl{config}, config::Error);
}

}  // namespace
}  // namespace sightline::gaze
