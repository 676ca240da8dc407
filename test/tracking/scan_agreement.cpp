#include "sightline/tracking/scan_agreement.h"

#include <gtest/gtest.h>

#include "scan_edits.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

const char* const kRoom = R"(
rooms:
  hall: {size: [6.0, 4.0], walls: {east: {spans: [[0.0, 1.5], [2.5, 4.0]]}}}
)";

ScanAgreement agreementIn(const world::RoomMap& map, const scan::Scan& scan, const Pose2& pose,
                          world::RoomView::Doors doors = world::RoomView::Doors::kOpen) {
  return scanAgreement(scan, pose, world::RoomView(map, 0, pose.translation(), doors), 0.1);
}

TEST(ScanAgreement, RightPoseFitsWhereWallsAre) {
  test::SimulatedRooms rooms(kRoom);
  const Pose2 pose(0.5, 0.3, 0.4);
  const ScanAgreement agreement = agreementIn(rooms.map, rooms.look(pose, 1), pose);
  EXPECT_GT(agreement.on_wall, 300U);
  EXPECT_EQ(agreement.beyond, 0U) << "beams through the opening in the east say nothing";
  EXPECT_DOUBLE_EQ(agreement.quality(), 1.0);
}

TEST(ScanAgreement, WrongHeadingSeesThroughWalls) {
  test::SimulatedRooms rooms(kRoom);
  const scan::Scan scan = rooms.look({0.5, 0.3, 0.4}, 1);
  const ScanAgreement agreement = agreementIn(rooms.map, scan, {0.5, 0.3, 0.9});
  EXPECT_LT(agreement.quality(), 0.5);
}

TEST(ScanAgreement, FurnitureSaysNothingAgainstAPose) {
  test::SimulatedRooms rooms(kRoom);
  const Pose2 pose(0.5, 0.3, 0.4);
  scan::Scan scan = rooms.look(pose, 1);
  for (std::size_t i = 0; i < scan.beams(); i += 2) {
    scan.setRange(i, 0.5 * scan.ranges()[i]);
  }
  const ScanAgreement agreement = agreementIn(rooms.map, scan, pose);
  EXPECT_GT(agreement.occluded, 100U);
  EXPECT_DOUBLE_EQ(agreement.quality(), 1.0);
}

TEST(ScanAgreement, NothingSeenWhereAWallIsInReachSpeaksAgainstThePose) {
  test::SimulatedRooms rooms(kRoom);
  const Pose2 pose(0.5, 0.3, 0.4);
  scan::Scan scan = rooms.look(pose, 1);
  test::setKinds(scan, scan::ReturnKind::kNothing);
  const ScanAgreement agreement = agreementIn(rooms.map, scan, pose);
  EXPECT_EQ(agreement.on_wall, 0U);
  EXPECT_GT(agreement.beyond, 300U);
}

TEST(ScanAgreement, NoWallInSightIsQualityZeroWithoutEvidence) {
  test::SimulatedRooms rooms(kRoom);
  scan::Scan scan = rooms.look({0.5, 0.3, 0.4}, 1);
  test::setKinds(scan, scan::ReturnKind::kInvalid);
  const ScanAgreement agreement = agreementIn(rooms.map, scan, {});
  EXPECT_EQ(agreement.on_wall + agreement.beyond + agreement.occluded, 0U);
  EXPECT_EQ(agreement.quality(), 0.0);
}

TEST(ScanAgreement, WhatTheMapDoesNotTellSaysNothingForAPoseOrAgainstIt) {
  test::SimulatedRooms rooms(kRoom);
  const auto geometry = rooms.look({}, 1).geometry();
  ScanAgreement agreement;
  agreement.on_wall = 90;
  agreement.occluded = 20;
  agreement.looked_at = 360;
  ScanAgreement with_unjudged = agreement;
  with_unjudged.unjudged = 250;
  EXPECT_DOUBLE_EQ(logLikelihood(agreement, *geometry, 0.8),
                   logLikelihood(with_unjudged, *geometry, 0.8));
  EXPECT_GT(logLikelihood(agreement, *geometry, 0.8), 0.0) << "just any other pose has 0";
}

TEST(ScanAgreement, FurnitureSpeaksAgainstAPoseOnlyWhereRoomsAreBare) {
  test::SimulatedRooms rooms(kRoom);
  const auto geometry = rooms.look({}, 1).geometry();
  ScanAgreement agreement;
  agreement.occluded = 100;
  agreement.looked_at = 360;
  EXPECT_NEAR(logLikelihood(agreement, *geometry, 0.6), 0.0, 1e-9);
  EXPECT_LT(logLikelihood(agreement, *geometry, 0.85), -0.1);
}

// However long it is, something along a wall is one thing, while beams through a wall are each a
// contradiction.
TEST(ScanAgreement, OneLongWallSaysLessThanTwoOfHalfTheLength) {
  test::SimulatedRooms rooms(kRoom);
  const auto geometry = rooms.look({}, 1).geometry();
  const Pose2 pose(0.5, 0.3, 0.4);
  const ScanAgreement seen = agreementIn(rooms.map, rooms.look(pose, 1), pose);
  EXPECT_GT(seen.repeated, 0.5 * static_cast<double>(seen.on_wall));
  const double most = 4.0 * std::log(7.6);
  EXPECT_LT(logLikelihood(seen, *geometry), most) << "four walls in sight";
  ScanAgreement through = seen;
  through.on_wall -= 40;
  through.beyond += 40;
  EXPECT_LT(logLikelihood(through, *geometry), logLikelihood(seen, *geometry) - 9.2);
}

const char* const kSuite = R"(
rooms:
  hall: {size: [6.0, 4.0]}
  study: {size: [4.0, 4.0], pose: [5.1, 0.0, 0.0]}
doors: [{between: [hall, study], at: [3.05, 0.0], width: 1.0}]
)";

TEST(ScanAgreement, WhatIsSeenThroughADoorCounts) {
  test::SimulatedRooms rooms(kSuite);
  const Pose2 pose(1.5, 0.1, 0.0);
  const scan::Scan scan = rooms.look(pose, 1);
  const auto open = agreementIn(rooms.map, scan, pose);
  const auto ignored = agreementIn(rooms.map, scan, pose, world::RoomView::Doors::kIgnored);
  EXPECT_EQ(open.beyond, 0U);
  EXPECT_GT(open.on_wall, ignored.on_wall + 30U);
}

TEST(ScanAgreement, InADoorwayBothRoomsCount) {
  test::SimulatedRooms rooms(kSuite);
  const Pose2 pose(3.05, 0.0, 1.5);
  const auto agreement = agreementIn(rooms.map, rooms.look(pose, 1), pose);
  EXPECT_GT(agreement.on_wall, 150U);
  EXPECT_DOUBLE_EQ(agreement.quality(), 1.0);
}

}  // namespace
}  // namespace sightline::tracking
