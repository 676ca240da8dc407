#include <gtest/gtest.h>

#include "mapped_floor.h"
#include "sightline/config/node.h"
#include "sightline/geometry/angle.h"
#include "sightline/mapping/replay.h"
#include "temporary_folder.h"

namespace sightline::mapping {
namespace {

// One room of 6 x 4 m with a door to another of 4 x 4 m, driven round.
const char* const kTwoRooms = R"(
rooms:
  left: {size: [6.0, 4.0], pose: [0.0, 0.0, 0.0]}
  right: {size: [4.0, 4.0], pose: [5.12, 0.0, 0.0]}
doors:
  - {between: [left, right], at: [3.06, 0.4], width: 0.9}
)";

bench::RecordedDrive driveThrough(const world::RoomMap& map) {
  bench::DriveSetup setup;
  setup.world = world::World::of(map);
  setup.start = {-2.0, -1.0, 0.0};
  setup.path.speed = 0.5;
  setup.path.waypoints_map = {{2.0, -1.0}, {2.0, 0.4}, {4.5, 0.4},  {6.0, 1.0},  {6.0, -1.0},
                              {4.5, 0.4},  {2.0, 0.4}, {-2.0, 1.0}, {-2.0, -1.0}};
  setup.scanner.beams = 181;
  setup.scanner.angle_min = -0.5 * geometry::kPi;
  setup.scanner.angle_max = 0.5 * geometry::kPi;
  setup.scanner.range_max = 8.0;
  setup.scanner.rate = 5.0;
  setup.robot.odometry.scale_mean = 1.02;
  setup.robot.odometry.scale_sigma = 0.0;
  setup.seconds = 75.0;
  return bench::recordDrive(setup, 3);
}

class FittedRoomsTest : public testing::Test {
 protected:
  const world::RoomMap truth_{config::Node::parse(kTwoRooms, "rooms")};
  const bench::RecordedDrive drive_ = driveThrough(truth_);
  const Survey survey_ = test::surveyOf(drive_, {});
  const FittedRooms fitted_ = fitRooms(survey_, {});
};

TEST_F(FittedRoomsTest, AreThoseThatWereDriven) {
  const auto errors =
      test::FloorComparison(fitted_, truth_, test::truthFromFitted(fitted_, drive_)).errors();
  EXPECT_EQ(errors.found, 2U);
  EXPECT_EQ(errors.invented, 0U);
  EXPECT_EQ(errors.unmatched_sides, 0U);
  EXPECT_EQ(errors.missing_doors, 0U);
  ASSERT_EQ(fitted_.doors.size(), 1U);
  EXPECT_LT(errors.door_place.at(0), 0.05);
  EXPECT_LT(errors.door_width.at(0), 0.1);
  ASSERT_GE(errors.sides.size(), 7U);
  for (const auto& side : errors.sides) EXPECT_LT(std::abs(side.offset), 0.015);
}

TEST_F(FittedRoomsTest, KnowHowCertainTheirSidesAre) {
  for (const RoomOutline& room : fitted_.rooms) {
    for (const SideLine& side : room.sides) {
      EXPECT_TRUE(side.is_seen);
      EXPECT_GT(side.covariance(0, 0), 1e-8);
      EXPECT_LT(side.covariance(0, 0), 0.02 * 0.02);
      EXPECT_GT(side.covariance.determinant(), 0.0);
    }
  }
}

TEST_F(FittedRoomsTest, LearnTheScaleOfTheWheels) {
  EXPECT_NEAR(fitted_.path.wheel_scale, 1.02, 0.006);
}

TEST_F(FittedRoomsTest, ReadBackAsAMap) {
  const world::RoomMap map(config::Node::parse(roomsText(fitted_), "fitted"));
  ASSERT_EQ(map.rooms().size(), 2U);
  EXPECT_EQ(map.doors().size(), 1U);
  EXPECT_TRUE(map.rooms()[0].is_rectangle);
}

TEST_F(FittedRoomsTest, AreTheSameToTheByte) {
  EXPECT_EQ(roomsText(fitRooms(survey_, {})), roomsText(fitted_));
}

TEST_F(FittedRoomsTest, KeepTheirPathInside) {
  EXPECT_GT(fitted_.inside, 0.97);
  ASSERT_EQ(fitted_.poses.size(), survey_.path().size());
  double worst = 0.0;
  const geometry::Pose2 T_truth_fitted = test::truthFromFitted(fitted_, drive_);
  for (const auto& pose : fitted_.poses) {
    const auto truth = *drive_.truth.at(pose.stamp);
    worst =
        std::max(worst, (T_truth_fitted * pose.pose.translation() - truth.translation()).norm());
  }
  EXPECT_LT(worst, 0.05);
}

TEST_F(FittedRoomsTest, ComeWithoutWheels) {
  const Survey alone = test::surveyOf(drive_, {}, /*with_wheels=*/false);
  EXPECT_EQ(alone.withWheels(), 0U);
  const FittedRooms fitted = fitRooms(alone, {});
  const auto errors =
      test::FloorComparison(fitted, truth_, test::truthFromFitted(fitted, drive_)).errors();
  EXPECT_EQ(errors.found, 2U);
  EXPECT_EQ(errors.missing_doors, 0U);
}

// The wheels fall silent half-way: dead reckoning goes on with the scans alone.
TEST_F(FittedRoomsTest, ComeWithWheelsThatFallSilent) {
  bench::RecordedDrive half = drive_;
  half.odometry.resize(half.odometry.size() / 2);
  const Survey survey = test::surveyOf(half, {});
  EXPECT_GT(survey.withWheels(), 0U);
  EXPECT_LT(survey.withWheels(), survey_.withWheels());
  const FittedRooms fitted = fitRooms(survey, {});
  const auto errors =
      test::FloorComparison(fitted, truth_, test::truthFromFitted(fitted, half)).errors();
  EXPECT_EQ(errors.found, 2U);
}

TEST_F(FittedRoomsTest, TellHowWellATrackerKnowsTheirWalls) {
  const world::RoomMap map(config::Node::parse(roomsText(fitted_), "fitted"));
  for (const world::Room& room : map.rooms()) {
    for (const world::Wall& wall : room.walls) {
      ASSERT_TRUE(wall.sigma) << room.name << ' ' << wall.name;
      EXPECT_GT(wall.sigma->position, 0.0001);
      EXPECT_LT(wall.sigma->position, 0.01);
    }
  }
}

// Wheels that are first heard of after the first scans, and count from elsewhere.
TEST_F(FittedRoomsTest, AreKeptWhereTheFirstScansHaveNoWheels) {
  const geometry::Pose2 T_wheels_odom(5.0, 3.0, 2.0);
  const auto readLate = [&](auto take) {
    std::size_t scans = 0;
    test::readDrive(drive_, {}, /*with_wheels=*/true, [&](pipeline::LocatedScan located) {
      for (auto* odometry : {&located.T_odom_base, &located.T_path_base}) {
        if (scans < 3) odometry->reset();
        if (*odometry) *odometry = T_wheels_odom * **odometry;
      }
      ++scans;
      take(std::move(located));
    });
  };
  Survey survey{pipeline::EstimatorsConfig()};
  readLate([&](pipeline::LocatedScan located) { survey.take(std::move(located)); });
  const FittedRooms fitted = fitRooms(survey, {});
  const test::TemporaryFolder folder;
  folder.write("rooms.yaml", roomsText(fitted));
  pipeline::EstimatorsConfig config;
  config.rooms.emplace();
  config.rooms->map = folder.path("rooms.yaml");
  Replay replay(config, fitted.poses, odometryOf(survey));
  readLate([&](pipeline::LocatedScan located) { replay.take(std::move(located)); });
  replay.finish();
  EXPECT_TRUE(replay.isGood()) << replay.rightShare();
  EXPECT_LT(replay.maxDifference(), 0.3);
}

// A yard with posts, and no wall.
TEST(FittedRooms, ClutterAloneIsNoBuilding) {
  bench::DriveSetup setup;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector2d place(1.7 * (i % 8) - 6.0 + 0.4 * (i % 3), 1.9 * (i / 8) - 7.0);
    if (std::abs(place.y()) > 0.8) setup.world.add(world::WorldDisc{place, 0.08, {}});
  }
  setup.start = {-5.0, 0.0, 0.0};
  setup.path.waypoints_map = {{5.0, 0.0}, {-5.0, 0.0}};
  setup.scanner.beams = 181;
  setup.scanner.angle_min = -0.5 * geometry::kPi;
  setup.scanner.angle_max = 0.5 * geometry::kPi;
  setup.scanner.range_max = 8.0;
  setup.scanner.rate = 5.0;
  setup.seconds = 40.0;
  const Survey survey = test::surveyOf(bench::recordDrive(setup, 3), {});
  EXPECT_TRUE(fitRooms(survey, {}).rooms.empty());
}

}  // namespace
}  // namespace sightline::mapping
