#include <algorithm>

#include <gtest/gtest.h>

#include "bench/mapping/other_buildings.h"
#include "mapped_floor.h"
#include "sightline/config/node.h"
#include "sightline/mapping/recorded_tracker.h"
#include "sightline/mapping/replay.h"
#include "sightline/mapping/wheel_fit.h"
#include "temporary_folder.h"

namespace sightline::mapping {
namespace {

struct FittedBuilding {
  bench::RecordedDrive drive;
  Survey survey;
  FittedRooms fitted;
  geometry::Pose2 T_truth_fitted;

  explicit FittedBuilding(const bench::OtherBuilding& building)
      : drive(bench::recordDrive(building.setup, 1)),
        survey(test::surveyOf(drive, {})),
        fitted(fitRooms(survey, {})),
        T_truth_fitted(test::truthFromFitted(fitted, drive)) {}

  // Distance of a true corner from the nearest one of a room.
  double offCorner(const RoomOutline& room, const Eigen::Vector2d& corner) const {
    double least = 1e9;
    for (std::size_t i = 0; i < room.sides.size(); ++i)
      least = std::min(least, (T_truth_fitted * room.side(i).start - corner).norm());
    return least;
  }
};

TEST(PolygonRooms, AnObliqueRoomHasTheSidesItHas) {
  const FittedBuilding building(bench::obliqueRoom());
  ASSERT_EQ(building.fitted.rooms.size(), 1U);
  const RoomOutline& room = building.fitted.rooms.front();
  EXPECT_GE(room.sides.size(), 6U);
  EXPECT_LE(room.sides.size(), 8U);
  for (const Eigen::Vector2d& corner : std::vector<Eigen::Vector2d>{
           {0.0, 0.0}, {7.0, 0.0}, {8.5, 3.0}, {6.0, 6.5}, {2.0, 7.0}, {-1.5, 4.0}}) {
    EXPECT_LT(building.offCorner(room, corner), 0.02) << corner.transpose();
  }
  const world::RoomMap map(config::Node::parse(roomsText(building.fitted), "fitted"));
  EXPECT_FALSE(map.rooms()[0].is_rectangle);
  EXPECT_EQ(map.rooms()[0].walls.size(), room.sides.size());
}

class RoundHallTest : public testing::Test {
 protected:
  const FittedBuilding building_{bench::roundHall()};
  const RoomOutline& hall() const {
    return *std::max_element(
        building_.fitted.rooms.begin(), building_.fitted.rooms.end(),
        [](const RoomOutline& a, const RoomOutline& b) { return a.area() < b.area(); });
  }

  // Largest error of a path, laid over the true one [m].
  double pathError(const std::vector<geometry::StampedPose2>& poses) const {
    FittedRooms fitted;
    fitted.poses = poses;
    const geometry::Pose2 T = test::truthFromFitted(fitted, building_.drive);
    double most = 0.0;
    for (const auto& pose : poses) {
      const auto truth = building_.drive.truth.at(pose.stamp)->translation();
      most = std::max(most, (T * pose.pose.translation() - truth).norm());
    }
    return most;
  }
};

TEST_F(RoundHallTest, IsDescribedByManySides) {
  ASSERT_EQ(building_.fitted.rooms.size(), 3U);
  EXPECT_TRUE(building_.fitted.missing_doors.empty());
  EXPECT_GT(hall().sides.size(), 10U);
  EXPECT_NEAR(hall().area(), geometry::kPi * 25.0, 2.0);
}

// An arc has another direction at each place of the side that stands for it.
TEST_F(RoundHallTest, SaysHowFarItsSidesAreFromTheWall) {
  const world::RoomMap map(config::Node::parse(roomsText(building_.fitted), "fitted"));
  const auto index = map.find(hall().name);
  ASSERT_TRUE(index);
  std::size_t bent = 0;
  for (const world::Wall& wall : map.rooms()[*index].walls) {
    const bool is_bent =
        wall.sigma && wall.sigma->position > 0.01 && wall.sigma->direction > geometry::radians(1.0);
    bent += is_bent ? 1 : 0;
  }
  EXPECT_GT(bent, 10U);
}

// Along a round wall a scan tells two of three coordinates: noise of these is none of the third.
TEST_F(RoundHallTest, DoesNotLeadDeadReckoningAstray) {
  EXPECT_LT(pathError(odometryOf(building_.survey)), 0.15);
}

TEST_F(RoundHallTest, IsDrivenWhereTheAdjustedPathLeads) {
  EXPECT_LT(pathError(building_.fitted.poses), 0.1);
}

// Of the robot of the simulation: 2 % of the way, 0.6 degrees a metre.
TEST_F(RoundHallTest, TellsTheErrorsOfTheWheels) {
  const auto wheels = fitWheels(building_.survey, building_.fitted.poses);
  ASSERT_TRUE(wheels);
  ASSERT_TRUE(wheels->scale.is_known);
  EXPECT_NEAR(wheels->scale.value, 1.02, 0.006);
  EXPECT_NEAR(wheels->heading.value, 0.0105, 0.004);
}

TEST_F(RoundHallTest, KeepsItsRecording) {
  const test::TemporaryFolder folder;
  folder.write("rooms.yaml", roomsText(building_.fitted));
  pipeline::EstimatorsConfig config;
  config.rooms.emplace();
  config.rooms->map = folder.path("rooms.yaml");
  config = withWheels(config, fitWheels(building_.survey, building_.fitted.poses));
  Replay replay(config, building_.fitted.poses, odometryOf(building_.survey));
  test::readDrive(building_.drive, {}, /*with_wheels=*/true,
                  [&](pipeline::LocatedScan located) { replay.take(std::move(located)); });
  replay.finish();
  EXPECT_TRUE(replay.isGood()) << replay.rightShare();
}

// A room of which half of the walls stand behind shelves and tables stays what it is.
TEST(PolygonRooms, FurnitureMakesNone) {
  bench::BuildingDrawer draw;
  draw.walls({{0.0, 0.0}, {6.0, 0.0}, {6.0, 5.0}, {0.0, 5.0}, {0.0, 0.0}});
  draw.walls({{0.5, 5.0}, {0.5, 4.6}, {2.8, 4.6}, {2.8, 5.0}});
  draw.walls({{3.4, 5.0}, {3.6, 4.5}, {4.6, 4.7}, {5.2, 5.0}});
  draw.walls({{6.0, 3.6}, {5.5, 3.5}, {5.4, 2.0}, {6.0, 1.9}});
  draw.arc({0.0, 2.5}, 0.7, -90.0, 90.0);
  const FittedBuilding building(draw.finish(
      "furnished", {1.5, 1.0, 0.0},
      {{4.5, 1.0}, {4.5, 3.5}, {2.5, 3.8}, {1.5, 2.5}, {1.5, 1.0}, {4.5, 1.0}}, 361, 20.0));
  ASSERT_EQ(building.fitted.rooms.size(), 1U);
  const auto rectangle = rectangleOf(building.fitted.rooms.front());
  ASSERT_TRUE(rectangle);
  EXPECT_NEAR(rectangle->size.maxCoeff(), 6.0, 0.05);
  EXPECT_NEAR(rectangle->size.minCoeff(), 5.0, 0.05);
}

}  // namespace
}  // namespace sightline::mapping
