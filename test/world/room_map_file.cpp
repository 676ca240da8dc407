#include "sightline/world/room_map_file.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::world {
namespace {

using Eigen::Vector2d;

void expectSame(const Room& a, const Room& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.T_map_room.coordinates(), b.T_map_room.coordinates()) << a.name;
  EXPECT_EQ(a.is_rectangle, b.is_rectangle) << a.name;
  ASSERT_EQ(a.walls.size(), b.walls.size()) << a.name;
  for (std::size_t i = 0; i < a.walls.size(); ++i) {
    EXPECT_EQ(a.walls[i].name, b.walls[i].name);
    EXPECT_EQ(a.walls[i].segment.start, b.walls[i].segment.start) << a.name << ' ' << i;
    ASSERT_EQ(a.walls[i].spans.size(), b.walls[i].spans.size()) << a.name << ' ' << i;
    for (std::size_t j = 0; j < a.walls[i].spans.size(); ++j) {
      EXPECT_EQ(a.walls[i].spans[j].from, b.walls[i].spans[j].from) << a.name << ' ' << i;
      EXPECT_EQ(a.walls[i].spans[j].to, b.walls[i].spans[j].to) << a.name << ' ' << i;
    }
  }
}

void expectSame(const RoomMap& a, const RoomMap& b) {
  ASSERT_EQ(a.rooms().size(), b.rooms().size());
  for (std::size_t i = 0; i < a.rooms().size(); ++i) expectSame(a.rooms()[i], b.rooms()[i]);
  ASSERT_EQ(a.doors().size(), b.doors().size());
  for (std::size_t i = 0; i < a.doors().size(); ++i) {
    const Door& left = a.doors()[i];
    const Door& right = b.doors()[i];
    for (const std::size_t side : {0U, 1U}) {
      EXPECT_EQ(left.rooms[side], right.rooms[side]);
      EXPECT_EQ(left.walls[side], right.walls[side]);
    }
    EXPECT_EQ(left.centre_map, right.centre_map);
    EXPECT_EQ(left.width, right.width);
    EXPECT_EQ(left.threshold, right.threshold);
  }
}

RoomMap readBack(const RoomMap& map) {
  return RoomMap(config::Node::parse(toYaml(map), "written"));
}

RoomMap floorPlan() {
  RoomMap map;
  const auto hall = map.addRectangle("hall", {8.1, 6.0}, {0.1, 0.2, 0.3});
  const auto tower = map.addPolygon("the \"tower\": 1", {{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}},
                                    {20.0, 0.0, 1.0 / 3.0});
  const auto study = map.addRectangle("007", {4.0, 3.0}, {6.2, 2.1, 0.3});
  map.setSpans({tower, 3}, {{0.5, 1.0}, {1.1, 1.0 + 1.0 / 3.0}});
  map.setSpans({hall, 0}, {});
  const Vector2d centre = map.rooms()[hall].walls[1].segment.midpoint();
  map.addDoor(hall, study, centre + 0.3 * map.rooms()[hall].walls[1].segment.direction(), 0.9,
              false);
  map.addDoor(hall, study, centre, 0.8);
  return map;
}

TEST(RoomMapFile, ReadsBackTheSameMap) {
  const RoomMap map = floorPlan();
  EXPECT_EQ(map.doors().size(), 2U);
  expectSame(map, readBack(map));
}

TEST(RoomMapFile, IsReadFromWhereItWasWritten) {
  const test::TemporaryFolder folder;
  writeFile(floorPlan(), folder.path("rooms.yaml"));
  expectSame(floorPlan(), RoomMap::readFile(folder.path("rooms.yaml")));
}

TEST(RoomMapFile, TurnsMayBeInDegrees) {
  const RoomMap map(
      config::Node::parse("rooms:\n  a: {size: [4, 2], pose: [1, 2], turn_deg: 90}\n  b: {size: "
                          "[1, 1], turn_deg: -45}\n",
                          "rooms"));
  EXPECT_NEAR(map.rooms()[0].T_map_room.theta(), 0.5 * geometry::kPi, 1e-12);
  EXPECT_EQ(map.rooms()[0].T_map_room.translation(), Vector2d(1.0, 2.0));
  EXPECT_NEAR(map.rooms()[1].T_map_room.theta(), -0.25 * geometry::kPi, 1e-12);
  EXPECT_THROW(RoomMap(config::Node::parse(
                   "rooms:\n  a: {size: [4, 2], pose: [1, 2, 0.1], turn_deg: 90}\n", "rooms")),
               config::Error);
}

TEST(RoomMapFile, ARectangleMayBeGivenByTwoCorners) {
  const RoomMap map(config::Node::parse(
      "rooms:\n  a: {corners: [[1, 2], [5, 4]]}\n  b: {corners: [[0, 0], [-2, 3]], turn_deg: 90}\n",
      "rooms"));
  EXPECT_EQ(map.rooms()[0].T_map_room.translation(), Vector2d(3.0, 3.0));
  EXPECT_EQ(map.rooms()[0].walls[0].segment.start, Vector2d(1.0, 2.0));
  EXPECT_NEAR(map.rooms()[1].walls[0].segment.length(), 3.0, 1e-12);
  EXPECT_LT((map.rooms()[1].walls[2].segment.start - Vector2d(-2.0, 3.0)).norm(), 1e-12);
}

TEST(RoomMapFile, SaysHowWellAWallIsKnown) {
  RoomMap map(config::Node::parse(
      "rooms:\n  a: {size: [4, 2], walls: {east: {sigma: [0.02, 0.003]}}}\n", "rooms"));
  EXPECT_FALSE(map.rooms()[0].walls[0].sigma);
  ASSERT_TRUE(map.rooms()[0].walls[1].sigma);
  EXPECT_EQ(map.rooms()[0].walls[1].spans.size(), 1U);
  map.setSigma({0, 3}, {0.1, 0.2});
  const RoomMap again = readBack(map);
  EXPECT_EQ(again.rooms()[0].walls[1].sigma->position, 0.02);
  EXPECT_EQ(again.rooms()[0].walls[3].sigma->direction, 0.2);
  EXPECT_FALSE(again.rooms()[0].walls[2].sigma);
}

TEST(RoomMapFile, SaysWhereItCannotBeWritten) {
  const config::Error error =
      test::errorOf([] { writeFile(floorPlan(), "/no/such/folder/rooms.yaml"); });
  EXPECT_STREQ(error.what(), "/no/such/folder/rooms.yaml: cannot be written");
}

TEST(RoomMapFile, KeepsEveryShippedMap) {
  for (const auto& file :
       std::filesystem::directory_iterator(SIGHTLINE_SOURCE_DIR "/config/rooms")) {
    const RoomMap map = RoomMap::readFile(file.path().string());
    expectSame(map, readBack(map));
  }
}

std::string faultOf(const std::function<void(RoomMap&)>& build) {
  RoomMap map;
  map.addRectangle("a", {4.0, 3.0});
  map.addRectangle("b", {4.0, 3.0}, {4.1, 0.0, 0.0});
  try {
    build(map);
  } catch (const InvalidRoomMap& fault) {
    return fault.key() + ": " + fault.what();
  }
  return "none";
}

TEST(RoomMapInCode, IsCheckedAsTheFileIs) {
  EXPECT_EQ(faultOf([](RoomMap& map) { map.addRectangle("a", {1.0, 1.0}); }), "name: 'a' is taken");
  EXPECT_EQ(faultOf([](RoomMap& map) {
              map.addRectangle("c", {0.0, 1.0});
            }),
            "size: 0 is outside [0.001, 1000000]");
  EXPECT_EQ(faultOf([](RoomMap& map) {
              map.addPolygon("c", {{0, 0}, {0, 1}, {1, 0}});
            }),
            "polygon: the corners have to run counter-clockwise round an area");
  EXPECT_EQ(faultOf([](RoomMap& map) {
              map.setSpans({0, 0}, {{0.0, 1.0}, {0.5, 2.0}});
            }),
            "1: overlaps the span before it");
  EXPECT_EQ(faultOf([](RoomMap& map) {
              map.addDoor(0, 0, {2.0, 0.0}, 0.9);
            }),
            "between: joins a room with itself");
  EXPECT_EQ(faultOf([](RoomMap& map) {
              map.addDoor(0, 1, {2.0, 0.0}, 9.0);
            }),
            "width: 9 m is wider than wall east of 'a', 3.000 m");
  EXPECT_EQ(faultOf([](RoomMap& map) {
              map.addDoor(0, 2, {2.0, 0.0}, 0.9);
            }),
            "between: no such room");
  EXPECT_EQ(faultOf([](RoomMap& map) { map.setSpans({0, 4}, {}); }), ": no such wall");
  EXPECT_EQ(faultOf([](RoomMap& map) { map.addDoor(0, 1, {2.0, 0.0}, 0.9); }), "none");
}

TEST(RoomMapInCode, AFaultChangesNothing) {
  RoomMap map;
  map.addRectangle("a", {4.0, 3.0});
  EXPECT_THROW(map.addDoor(0, 0, {2.0, 0.0}, 0.9), InvalidRoomMap);
  EXPECT_THROW(map.setSpans({0, 0}, {{1.0, 9.0}}), InvalidRoomMap);
  EXPECT_EQ(map.rooms()[0].walls[1].spans.size(), 1U);
  EXPECT_TRUE(map.doors().empty());
}

}  // namespace
}  // namespace sightline::world
