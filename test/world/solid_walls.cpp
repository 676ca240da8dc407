#include <gtest/gtest.h>

#include "sightline/world/world.h"

namespace sightline::world {
namespace {

RoomMap solidMap(const std::string& text) {
  return RoomMap(config::Node::parse(text, "rooms.yaml"));
}

World worldOfWalls(const RoomMap& map) {
  World world;
  for (const auto& segment : solidWalls(map)) world.add(WorldSegment{segment, 0.0, 2.0, 0});
  return world;
}

TEST(SolidWalls, KeepOnlyTheSpansThatAreThere) {
  const auto walls = solidWalls(solidMap(
      "rooms: {a: {size: [4, 2], walls: {north: {spans: [[0, 1], [3, 4]]}, east: {open: true}}}}"));
  ASSERT_EQ(walls.size(), 4u);
  EXPECT_NEAR(walls[1].start.x(), 2.0, 1e-12) << "north runs from east to west";
  EXPECT_NEAR(walls[1].end.x(), 1.0, 1e-12);
  EXPECT_NEAR(walls[2].end.x(), -2.0, 1e-12);
}

TEST(SolidWalls, WallsThatTouchNeedNoJambs) {
  const auto walls = solidWalls(solidMap(R"(
rooms: {a: {size: [2, 2], pose: [-1, 0, 0]}, b: {size: [2, 2], pose: [1, 0, 0]}}
doors: [{between: [a, b], at: [0, 0], width: 0.8}]
)"));
  EXPECT_EQ(walls.size(), 10u);
}

// No ray from anywhere in either room may leave the rooms and the opening of the door.
TEST(SolidWalls, NobodyLooksBetweenTheWallsOfADoor) {
  const RoomMap map = solidMap(R"(
rooms:
  corridor: {size: [12, 2], pose: [0, -1, 0]}
  office: {size: [4, 3], pose: [-1, 1.62, 3.141592653589793]}
doors: [{between: [office, corridor], at: [-0.3, 0.06], width: 0.9}]
)");
  const World world = worldOfWalls(map);
  EXPECT_EQ(world.segments().size(), 12u);
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(-0.3, -1.0, 1),
                                     {3.0, -0.2, 1},
                                     {-5.0, -0.3, 1},
                                     {-2.5, 2.0, 1},
                                     {0.5, 0.3, 1},
                                     {-0.3, 0.06, 1}}) {
    for (int i = 0; i < 3600; ++i) {
      const double angle = geometry::radians(0.1 * i);
      const auto hit = world.cast({eye, {std::cos(angle), std::sin(angle), 0.0}});
      ASSERT_TRUE(hit) << eye.transpose() << " looking to " << 0.1 * i;
      const Eigen::Vector2d p =
          eye.head<2>() + (hit->range - 1e-6) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const bool in_door = p.y() > 0.0 && p.y() < 0.12 && std::abs(p.x() + 0.3) < 0.45;
      EXPECT_TRUE(in_door || map.roomAt(p)) << p.transpose();
    }
  }
}

}  // namespace
}  // namespace sightline::world
