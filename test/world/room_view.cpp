#include "sightline/world/room_view.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sightline/world/world.h"

namespace sightline::world {
namespace {

using Eigen::Vector2d;

// Three rooms in a row with walls of 0.1 m between them, and one that no door leads to.
RoomMap suite() {
  RoomMap map;
  map.addRectangle("west", {6.0, 4.0});
  map.addRectangle("middle", {4.0, 4.0}, {5.1, 0.0, 0.0});
  map.addPolygon("east", {{0, -2}, {5, -2}, {5, 2}, {2, 2}, {2, 1}, {0, 1}}, {7.2, 0.0, 0.0});
  map.addRectangle("shut", {6.0, 2.0}, {0.0, 3.1, 0.0});
  map.setSpans({1, 2}, {{0.0, 1.0}, {2.0, 4.0}});
  map.addDoor(0, 1, {3.05, 0.2}, 0.9);
  map.addDoor(1, 2, {7.15, 0.1}, 0.9);
  return map;
}

Vector2d towards(double degrees) {
  return {std::cos(geometry::radians(degrees)), std::sin(geometry::radians(degrees))};
}

TEST(RoomView, MeetsTheWallAhead) {
  const RoomMap map = suite();
  const RoomView view(map, 0, {-1.0, 0.5}, RoomView::Doors::kOpen);
  const auto sighting = view.look(towards(135.0));
  ASSERT_TRUE(sighting);
  EXPECT_EQ(sighting->wall.room, 0U);
  EXPECT_EQ(sighting->wall.wall, 2U);
  EXPECT_NEAR(sighting->range, 1.5 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(sighting->along, 5.5, 1e-12) << "north runs from east to west";
  EXPECT_NEAR(sighting->cos_incidence, std::sqrt(0.5), 1e-12);
  EXPECT_TRUE(sighting->is_solid);
  EXPECT_NEAR(sighting->margin, 0.5, 1e-12);
}

TEST(RoomView, SeesThroughTwoDoors) {
  const RoomMap map = suite();
  const auto sighting = RoomView(map, 0, {-1.0, 0.15}, RoomView::Doors::kOpen).look(towards(0.0));
  ASSERT_TRUE(sighting);
  EXPECT_EQ(sighting->wall.room, 2U);
  EXPECT_NEAR(sighting->range, 13.2, 1e-12);
  EXPECT_NEAR(sighting->margin, 0.4, 1e-12) << "from the nearer jamb";
}

TEST(RoomView, DoorsCanBeIgnored) {
  const RoomMap map = suite();
  const auto sighting =
      RoomView(map, 0, {-1.0, 0.15}, RoomView::Doors::kIgnored).look(towards(0.0));
  ASSERT_TRUE(sighting);
  EXPECT_EQ(sighting->wall.room, 0U);
  EXPECT_FALSE(sighting->is_solid);
}

TEST(RoomView, AJambSaysNothing) {
  const RoomMap map = suite();
  // Enters the door of 0.1 m of depth by its edge and meets the other one.
  const Vector2d eye(2.9, -1.0);
  const Vector2d edge(3.05, 0.62);
  const auto sighting =
      RoomView(map, 0, eye, RoomView::Doors::kOpen).look((edge - eye).normalized());
  ASSERT_TRUE(sighting);
  EXPECT_EQ(sighting->wall.room, 0U);
  EXPECT_FALSE(sighting->is_solid);
}

TEST(RoomView, FromADoorwayTheNextRoomIsSeen) {
  const RoomMap map = suite();
  const RoomView view(map, 0, {3.05, 0.2}, RoomView::Doors::kOpen);
  const auto ahead = view.look(towards(30.0));
  ASSERT_TRUE(ahead);
  EXPECT_EQ(ahead->wall.room, 1U);
  const auto back = view.look(towards(180.0));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->wall.room, 0U);
}

// Wherever a solid wall is met, the world built of the same walls has it at the same range.
TEST(RoomView, AgreesWithTheWorldOfTheSameWalls) {
  const RoomMap map = suite();
  const World world = World::of(map);
  int seen = 0;
  for (const auto& [room, eye] : {std::pair<std::size_t, Vector2d>{0, {-1.0, 0.5}},
                                  {0, {2.5, -0.3}},
                                  {1, {4.0, 1.0}},
                                  {1, {6.9, 0.0}},
                                  {2, {8.0, -1.0}},
                                  {0, {3.05, 0.3}}}) {
    const RoomView view(map, room, eye, RoomView::Doors::kOpen);
    for (double degrees = 0.05; degrees < 360.0; degrees += 0.1) {
      const auto sighting = view.look(towards(degrees));
      if (!sighting || !sighting->is_solid) continue;
      ++seen;
      const Eigen::Vector3d direction(towards(degrees).x(), towards(degrees).y(), 0.0);
      const auto hit = world.cast({{eye.x(), eye.y(), 1.0}, direction});
      ASSERT_TRUE(hit) << eye.transpose() << " at " << degrees;
      ASSERT_NEAR(hit->range, sighting->range, 1e-9) << eye.transpose() << " at " << degrees;
      ASSERT_NEAR(hit->cos_incidence, sighting->cos_incidence, 1e-9);
    }
  }
  EXPECT_GT(seen, 6 * 3600 * 0.85);
}

}  // namespace
}  // namespace sightline::world
