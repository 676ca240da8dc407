#include "sightline/world/occupancy.h"

#include <gtest/gtest.h>

namespace sightline::world {
namespace {

const char* const kRooms = R"(
rooms:
  west: {size: [4.0, 4.0], pose: [0.0, 0.0, 0.0], walls: {south: {spans: [[0.0, 1.0]]}}}
  east: {size: [2.0, 4.0], pose: [3.2, 0.0, 0.0]}
doors:
  - {between: [west, east], at: [2.1, 0.5], width: 0.9}
)";

TEST(Occupancy, DrawsRoomsWallsAndDoors) {
  const Occupancy grid = drawRooms(RoomMap(config::Node::parse(kRooms, "rooms")), 0.05);
  EXPECT_EQ(grid.at({0.0, 0.0}), Occupancy::kFree);
  EXPECT_EQ(grid.at({3.2, 0.0}), Occupancy::kFree);
  EXPECT_EQ(grid.at({-2.0, 0.0}), Occupancy::kOccupied);
  EXPECT_EQ(grid.at({1.0, -2.0}), Occupancy::kOccupied) << "no robot leaves where no door is";
  EXPECT_EQ(grid.at({2.0, -1.5}), Occupancy::kOccupied);
  EXPECT_EQ(grid.at({0.0, 2.7}), Occupancy::kUnknown);
  EXPECT_EQ(grid.at({100.0, 0.0}), Occupancy::kUnknown);
  for (double x = 1.8; x < 2.4; x += 0.02) {
    EXPECT_EQ(grid.at({x, 0.5}), Occupancy::kFree) << "through the door at " << x;
  }
}

TEST(Occupancy, CoversTheRoomsWithAMargin) {
  const Occupancy grid = drawRooms(RoomMap(config::Node::parse(kRooms, "rooms")), 0.1);
  EXPECT_NEAR(grid.origin.x(), -3.0, 1e-9);
  EXPECT_NEAR(grid.origin.y(), -3.0, 1e-9);
  EXPECT_EQ(grid.width, 82U);
  EXPECT_EQ(grid.height, 60U);
  EXPECT_EQ(grid.cells.size(), grid.width * grid.height);
}

}  // namespace
}  // namespace sightline::world
