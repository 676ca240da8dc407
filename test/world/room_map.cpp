#include "sightline/world/room_map.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace sightline::world {
namespace {

using Eigen::Vector2d;
using geometry::kPi;

RoomMap parse(const std::string& text) {
  return RoomMap(config::Node::parse(text, "rooms.yaml"));
}

// Two rooms side by side with a wall of 0.2 m between them, and a tower apart.
const char kFloor[] = R"(
rooms:
  hall: {size: [8.0, 6.0]}
  study:
    size: [4.0, 3.0]
    pose: [6.2, 1.0, 0.0]
    walls:
      north: {spans: [[0.5, 1.5], [1.5, 2.0], [3.0, 4.01]]}
      east: {open: true}
  tower: {polygon: [[0, 0], [4, 0], [4, 3], [2, 1], [0, 3]], pose: [20.0, 0.0, 1.5707963267948966]}
doors:
  - {between: [hall, study], at: [4.1, 0.5], width: 0.9}
  - {between: [study, hall], at: [4.1, 2.0], width: 0.6, threshold: false}
)";

void expectSpans(const Wall& wall, const std::vector<Span>& expected) {
  ASSERT_EQ(wall.spans.size(), expected.size()) << wall.name;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(wall.spans[i].from, expected[i].from, 1e-12) << wall.name;
    EXPECT_NEAR(wall.spans[i].to, expected[i].to, 1e-12) << wall.name;
  }
}

TEST(RoomMap, KeepsTheRoomsInTheOrderOfTheFile) {
  const RoomMap map = parse(kFloor);
  ASSERT_EQ(map.rooms().size(), 3u);
  EXPECT_EQ(map.rooms()[0].name, "hall");
  EXPECT_EQ(map.rooms()[2].name, "tower");
  EXPECT_EQ(map.find("study"), 1u);
  EXPECT_FALSE(map.find("cellar"));
}

TEST(RoomMap, NamesTheWallsOfARectangleByCompass) {
  const Room room = parse("rooms: {hall: {size: [8, 6], pose: [1, 2, 0]}}").rooms()[0];
  ASSERT_EQ(room.walls.size(), 4u);
  EXPECT_EQ(room.walls[0].name, "south");
  EXPECT_LT((room.walls[0].segment.midpoint() - Vector2d(1.0, -1.0)).norm(), 1e-15);
  EXPECT_EQ(room.walls[1].name, "east");
  EXPECT_LT((room.walls[1].segment.midpoint() - Vector2d(5.0, 2.0)).norm(), 1e-15);
  EXPECT_EQ(room.walls[2].name, "north");
  EXPECT_LT((room.walls[2].segment.midpoint() - Vector2d(1.0, 5.0)).norm(), 1e-15);
  EXPECT_EQ(room.walls[3].name, "west");
  EXPECT_LT((room.walls[3].segment.midpoint() - Vector2d(-3.0, 2.0)).norm(), 1e-15);
}

TEST(RoomMap, NumbersTheWallsOfAPolygonFromItsCorners) {
  const Room tower = parse(kFloor).rooms()[2];
  ASSERT_EQ(tower.walls.size(), 5u);
  EXPECT_EQ(tower.walls[3].name, "3");
  // Corners (2, 1) and (0, 3), a quarter turn on and 20 m away.
  EXPECT_LT((tower.walls[3].segment.start - Vector2d(19.0, 2.0)).norm(), 1e-14);
  EXPECT_LT((tower.walls[3].segment.end - Vector2d(17.0, 0.0)).norm(), 1e-14);
}

TEST(RoomMap, RunsWallsCounterClockwiseWithTheInsideOnTheLeft) {
  const RoomMap map = parse(kFloor);
  for (const Room& room : map.rooms()) {
    for (std::size_t i = 0; i < room.walls.size(); ++i) {
      const geometry::Segment& wall = room.walls[i].segment;
      const geometry::Segment& next = room.walls[(i + 1) % room.walls.size()].segment;
      EXPECT_LT((wall.end - next.start).norm(), 1e-14);
      EXPECT_TRUE(room.contains(wall.midpoint() + 0.01 * wall.leftNormal()));
      EXPECT_FALSE(room.contains(wall.midpoint() - 0.01 * wall.leftNormal()));
    }
  }
}

TEST(RoomMap, TurnsARoomByItsPose) {
  const Room room = parse("rooms: {a: {size: [4, 2], pose: [3, 1, 0.5]}}").rooms()[0];
  EXPECT_NEAR(room.T_map_room.theta(), 0.5, 1e-15);
  const geometry::Segment south = room.walls[0].segment;
  EXPECT_LT((south.start - room.T_map_room * Vector2d(-2.0, -1.0)).norm(), 1e-15);
  EXPECT_LT((south.end - room.T_map_room * Vector2d(2.0, -1.0)).norm(), 1e-15);
}

TEST(RoomMap, HasAWallOverItsWholeLengthUnlessToldOtherwise) {
  const RoomMap map = parse(kFloor);
  expectSpans(map.rooms()[0].walls[0], {{0.0, 8.0}});
  expectSpans(map.rooms()[2].walls[0], {{0.0, 4.0}});
}

TEST(RoomMap, KeepsTheSpansOfAWall) {
  const RoomMap map = parse(kFloor);
  const Room& study = map.rooms()[1];
  // The last one overshot the corner by a centimetre.
  expectSpans(study.walls[2], {{0.5, 1.5}, {1.5, 2.0}, {3.0, 4.0}});
  expectSpans(study.walls[1], {});
}

TEST(RoomMap, LeavesDoorsOutOfBothWalls) {
  const RoomMap map = parse(kFloor);
  // East of the hall runs up from y = −3; west of the study runs down from y = 2.5.
  expectSpans(map.rooms()[0].walls[1], {{0.0, 3.05}, {3.95, 4.7}, {5.3, 6.0}});
  expectSpans(map.rooms()[1].walls[3], {{0.0, 0.2}, {0.8, 1.55}, {2.45, 3.0}});
}

TEST(RoomMap, CutsADoorOutOfTheSpansThatAreThere) {
  const RoomMap map = parse(R"(
rooms:
  a: {size: [4, 4], walls: {east: {spans: [[0.0, 1.9], [2.1, 2.3], [3.0, 4.0]]}}}
  b: {size: [4, 4], pose: [4, 0, 0], walls: {west: {open: true}}}
doors: [{between: [a, b], at: [2.0, 0.0], width: 1.0}]
)");
  expectSpans(map.rooms()[0].walls[1], {{0.0, 1.5}, {3.0, 4.0}});
  expectSpans(map.rooms()[1].walls[3], {});
}

TEST(RoomMap, LetsADoorReachTheCorner) {
  const RoomMap map = parse(R"(
rooms:
  a: {size: [4, 1]}
  b: {size: [4, 4], pose: [4, 0, 0]}
doors: [{between: [a, b], at: [2.0, 0.0], width: 1.0}]
)");
  expectSpans(map.rooms()[0].walls[1], {});
  expectSpans(map.rooms()[1].walls[3], {{0.0, 1.5}, {2.5, 4.0}});
}

TEST(RoomMap, KnowsItsDoors) {
  const RoomMap map = parse(kFloor);
  ASSERT_EQ(map.doors().size(), 2u);
  const Door& door = map.doors()[0];
  EXPECT_EQ(door.rooms[0], 0u);
  EXPECT_EQ(door.rooms[1], 1u);
  EXPECT_EQ(door.walls[0], 1u);
  EXPECT_EQ(door.walls[1], 3u);
  EXPECT_EQ(door.width, 0.9);
  EXPECT_TRUE(door.threshold);
  EXPECT_FALSE(map.doors()[1].threshold);
}

TEST(RoomMap, FindsTheDoorBetweenTwoRoomsThatIsNearest) {
  const RoomMap map = parse(kFloor);
  EXPECT_EQ(map.doorBetween(0, 1, {4.0, 0.0}), &map.doors()[0]);
  EXPECT_EQ(map.doorBetween(1, 0, {4.0, 3.0}), &map.doors()[1]);
  EXPECT_EQ(map.doorBetween(0, 2, {4.0, 3.0}), nullptr);
  EXPECT_EQ(map.doorBetween(1, 1, {4.0, 3.0}), nullptr);
}

TEST(Room, ContainsWhatLiesWithinItsWalls) {
  const Room tower = parse(kFloor).rooms()[2];
  const auto contains = [&](double x, double y) {
    return tower.contains(tower.T_map_room * Vector2d(x, y));
  };
  EXPECT_TRUE(contains(2.0, 0.5));
  EXPECT_TRUE(contains(0.3, 2.0));
  EXPECT_TRUE(contains(3.7, 2.0));
  EXPECT_FALSE(contains(2.0, 2.0));  // in the notch
  EXPECT_FALSE(contains(-0.1, 1.0));
  EXPECT_FALSE(contains(4.1, 1.0));
  EXPECT_FALSE(contains(2.0, -0.1));
}

TEST(Room, MeasuresTheDistanceToItsNearestSide) {
  const Room hall = parse(kFloor).rooms()[0];
  EXPECT_EQ(hall.distance({0.0, 0.0}), 0.0);
  EXPECT_NEAR(hall.distance({6.0, 0.0}), 2.0, 1e-15);
  EXPECT_NEAR(hall.distance({7.0, 7.0}), 5.0, 1e-15);
}

TEST(RoomMap, FindsTheRoomOfAPoint) {
  const RoomMap map = parse(kFloor);
  EXPECT_EQ(map.roomAt({0.0, 0.0}), 0u);
  EXPECT_EQ(map.roomAt({6.0, 1.0}), 1u);
  EXPECT_FALSE(map.roomAt({4.1, 0.5}));  // in the door
  EXPECT_FALSE(map.roomAt({100.0, 0.0}));
  EXPECT_EQ(map.nearestRoom({4.05, 0.5}), 0u);
  EXPECT_EQ(map.nearestRoom({4.15, 0.5}), 1u);
  EXPECT_EQ(map.nearestRoom({100.0, 0.0}), 2u);
}

TEST(RoomMap, PrefersTheGivenOneOfOverlappingRooms) {
  const RoomMap map = parse("rooms: {a: {size: [4, 4]}, b: {size: [4, 4], pose: [1, 0, 0]}}");
  EXPECT_EQ(map.roomAt({0.5, 0.0}), 0u);
  EXPECT_EQ(map.roomAt({0.5, 0.0}, 0), 0u);
  EXPECT_EQ(map.roomAt({0.5, 0.0}, 1), 1u);
  EXPECT_EQ(map.roomAt({-1.5, 0.0}, 1), 0u);
}

TEST(RoomMap, ReadsEveryShippedFile) {
  int files = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(SIGHTLINE_SOURCE_DIR "/config/rooms")) {
    EXPECT_NO_THROW(EXPECT_FALSE(RoomMap::readFile(file.path().string()).rooms().empty()))
        << file.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace sightline::world
