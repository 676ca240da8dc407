#include "sightline/tracking/room_fit.h"
#include "scan_edits.h"

#include <gtest/gtest.h>

#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

const char* const kRoom = R"(
rooms:
  hall: {size: [6.0, 4.0], walls: {east: {spans: [[0.0, 1.5], [2.5, 4.0]]}}}
)";

TEST(RoomFit, RightPoseFitsWhereWallsAre) {
  test::SimulatedRooms rooms(kRoom);
  const Pose2 pose(0.5, 0.3, 0.4);
  const RoomFit fit = fitToRoom(rooms.look(pose, 1), pose, rooms.map.rooms()[0], 0.1);
  EXPECT_GT(fit.on_wall, 300U);
  EXPECT_EQ(fit.beyond, 0U) << "beams through the opening in the east say nothing";
  EXPECT_DOUBLE_EQ(fit.quality(), 1.0);
}

TEST(RoomFit, WrongHeadingSeesThroughWalls) {
  test::SimulatedRooms rooms(kRoom);
  const scan::Scan scan = rooms.look({0.5, 0.3, 0.4}, 1);
  const RoomFit fit = fitToRoom(scan, {0.5, 0.3, 0.9}, rooms.map.rooms()[0], 0.1);
  EXPECT_LT(fit.quality(), 0.5);
}

TEST(RoomFit, FurnitureSaysNothingAgainstAPose) {
  test::SimulatedRooms rooms(kRoom);
  const Pose2 pose(0.5, 0.3, 0.4);
  scan::Scan scan = rooms.look(pose, 1);
  for (std::size_t i = 0; i < scan.beams(); i += 2) {
    scan.setRange(i, 0.5 * scan.ranges()[i]);
  }
  const RoomFit fit = fitToRoom(scan, pose, rooms.map.rooms()[0], 0.1);
  EXPECT_GT(fit.occluded, 100U);
  EXPECT_DOUBLE_EQ(fit.quality(), 1.0);
}

TEST(RoomFit, NothingSeenWhereAWallIsInReachSpeaksAgainstThePose) {
  test::SimulatedRooms rooms(kRoom);
  const Pose2 pose(0.5, 0.3, 0.4);
  scan::Scan scan = rooms.look(pose, 1);
  test::setKinds(scan, scan::ReturnKind::kNothing);
  const RoomFit fit = fitToRoom(scan, pose, rooms.map.rooms()[0], 0.1);
  EXPECT_EQ(fit.on_wall, 0U);
  EXPECT_GT(fit.beyond, 300U);
}

TEST(RoomFit, NoWallInSightIsQualityZeroWithoutEvidence) {
  test::SimulatedRooms rooms(kRoom);
  scan::Scan scan = rooms.look({0.5, 0.3, 0.4}, 1);
  test::setKinds(scan, scan::ReturnKind::kInvalid);
  const RoomFit fit = fitToRoom(scan, {}, rooms.map.rooms()[0], 0.1);
  EXPECT_EQ(fit.on_wall + fit.beyond + fit.occluded, 0U);
  EXPECT_EQ(fit.quality(), 0.0);
}

}  // namespace
}  // namespace sightline::tracking
