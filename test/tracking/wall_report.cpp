#include "sightline/tracking/wall_report.h"

#include <cstdint>

#include <gtest/gtest.h>

#include "sightline/tracking/room_tracker.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

// The north wall is drawn 25 mm too far out: it stands further in.
TEST(WallReport, NamesTheWallThatIsOff) {
  test::SimulatedRooms real(
      "rooms:\n  hall: {polygon: [[-3, -2], [3, -2], [3, 1.975], [-3, 1.975]]}\n");
  const world::RoomMap drawn(config::Node::parse("rooms:\n  hall: {size: [6.0, 4.0]}\n", "rooms"));
  TrackerConfig config;
  config.wall.position_sigma = 0.02;
  RoomTracker tracker(config, drawn);
  Pose2 truth(-1.0, -0.6, 0.2);
  tracker.setPose({truth, Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal()});
  WallReport report;
  for (int i = 0; i < 100; ++i) {
    const auto update =
        tracker.update(real.look(truth, std::int64_t{100'000'000} * (i + 1)), truth, {});
    if (update) report.add(*update, drawn);
    truth = truth * Pose2(0.02, 0.0, 0.07);
  }
  double north = 0.0;
  double south = 0.0;
  for (const WallUse& use : report.uses(drawn)) {
    EXPECT_EQ(use.room, "hall");
    EXPECT_GT(use.fitted, 20U);
    EXPECT_LE(use.used, use.fitted);
    if (use.wall == "north") north = use.mean_offset;
    if (use.wall == "south") south = use.mean_offset;
    if (use.wall == "east") {
      EXPECT_NEAR(use.mean_offset, 0.0, 0.004);
    }
  }
  // Both walls together say that the room is narrower; whose fault it is, they cannot say.
  EXPECT_NEAR(north + south, 0.025, 0.006);
}

TEST(WallReport, KnowsNothingBeforeAScan) {
  const world::RoomMap map(config::Node::parse("rooms:\n  hall: {size: [6.0, 4.0]}\n", "rooms"));
  EXPECT_TRUE(WallReport().uses(map).empty());
}

}  // namespace
}  // namespace sightline::tracking
