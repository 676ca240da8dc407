#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sightline/world/world.h"

namespace sightline::world {
namespace {

using testing::HasSubstr;

World worldFrom(const std::string& text) {
  return World(config::Node::parse(text, "w.yaml"));
}

std::string worldErrorOf(const std::string& text) {
  try {
    worldFrom(text);
  } catch (const config::Error& error) {
    return error.what();
  }
  return "no error";
}

// A folder of its own for the files of one test.
class WorldFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = std::filesystem::temp_directory_path() / "sightline_world_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  }

  std::filesystem::path folder_;
};

TEST(WorldFile, ReadsEveryKindOfThing) {
  const World world = worldFrom(R"(
materials: {wood: {reflectivity: 0.4}}
walls: {height: 3.0}
floor: {material: wood}
ceiling: {height: 3.0}
segments: [{from: [0, 0], to: [2, 0]}]
boxes: [{centre: [1, 2], size: [1, 0.5], yaw: 1.5707963267948966, bottom: 0.7, top: 0.75, material: wood}]
discs: [{centre: [3, 3], radius: 0.1, top: 0.7}]
)");
  ASSERT_EQ(world.segments().size(), 5u);
  EXPECT_EQ(world.segments()[0].top, 3.0);
  EXPECT_EQ(world.segments()[1].bottom, 0.7);
  EXPECT_EQ(world.materials()[world.segments()[1].material].name, "wood");
  ASSERT_EQ(world.discs().size(), 1u);
  EXPECT_EQ(world.discs()[0].top, 0.7);
  ASSERT_EQ(world.plates().size(), 4u) << "floor, ceiling, bottom and top of the box";
  const auto hit = world.cast({{1.0, 0.5, 0.72}, {0.0, 1.0, 0.0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, 1.0, 1e-12) << "the turned box is 1 m long in y";
}

TEST(WorldFile, RayFromAboveMeetsTheTopOfABoxAndFromBelowItsBottom) {
  const World world = worldFrom("boxes: [{centre: [0, 0], size: [1, 1], bottom: 0.5, top: 0.8}]");
  EXPECT_NEAR(world.cast({{0.1, 0.1, 2.0}, {0.0, 0.0, -1.0}})->range, 1.2, 1e-12);
  EXPECT_NEAR(world.cast({{0.1, 0.1, 0.0}, {0.0, 0.0, 1.0}})->range, 0.5, 1e-12);
}

TEST(WorldFile, EmptyMapIsAnEmptyWorld) {
  EXPECT_TRUE(worldFrom("{}").segments().empty());
}

TEST(WorldFile, ErrorsNameFileLineAndKey) {
  EXPECT_THAT(worldErrorOf("segments:\n  - {from: [0, 0]}"),
              HasSubstr("w.yaml:2: segments[0]: missing key 'to'"));
  EXPECT_THAT(worldErrorOf("segments:\n  - {from: [0, 0], to: [0, 0]}"), HasSubstr("same point"));
  EXPECT_THAT(worldErrorOf("boxes:\n  - centre: [0, 0]\n    size: [-1, 2]"),
              HasSubstr("w.yaml:3: boxes[0].size[0]: -1 is outside"));
  EXPECT_THAT(worldErrorOf("boxes:\n  - centre: [0, 0]\n    size: [1]"),
              HasSubstr("expected 2 numbers"));
  EXPECT_THAT(worldErrorOf("discs:\n  - {centre: [0, 0], radius: 0}"),
              HasSubstr("w.yaml:2: discs[0].radius: 0 is outside"));
  EXPECT_THAT(worldErrorOf("discs:\n  - {centre: [0, x], radius: 1}"),
              HasSubstr("discs[0].centre[1]: expected a number, found 'x'"));
  EXPECT_THAT(worldErrorOf("discs:\n  - {centre: [0, 0], radius: 1, material: fog}"),
              HasSubstr("w.yaml:2: discs[0].material: no material is called 'fog'"));
  EXPECT_THAT(worldErrorOf("discs:\n  - {centre: [0, 0], radius: 1, bottom: 2, top: 1}"),
              HasSubstr("bottom 2 m is not below top 1 m"));
  EXPECT_THAT(worldErrorOf("materials:\n  fog: {reflectivity: -0.1}"),
              HasSubstr("w.yaml:2: materials.fog.reflectivity: -0.1 is outside"));
  EXPECT_THAT(worldErrorOf("ceiling: {material: plaster}"), HasSubstr("missing key 'height'"));
  EXPECT_THAT(worldErrorOf("wall: {}"), HasSubstr("w.yaml:1: wall: unknown key"));
  EXPECT_THAT(worldErrorOf("boxes: 3"), HasSubstr("w.yaml:1: boxes: expected a sequence"));
  EXPECT_THAT(worldErrorOf("- 1"), HasSubstr("expected a map"));
}

TEST_F(WorldFiles, TakesItsWallsFromARoomsFile) {
  write("rooms/two.yaml", R"(
rooms:
  left: {size: [4, 3], pose: [-2.05, 0, 0]}
  right: {size: [4, 3], pose: [2.05, 0, 0]}
doors: [{between: [left, right], at: [0, 0.5], width: 0.9}]
)");
  const World world =
      World::readFile(write("worlds/two.yaml", "rooms: ../rooms/two.yaml\nwalls: {height: 2.2}"));
  EXPECT_EQ(world.segments().size(), 12u) << "six whole walls, two cut in two, two jambs";
  for (const WorldSegment& segment : world.segments()) EXPECT_EQ(segment.top, 2.2);
  EXPECT_NEAR(world.cast({{-2.0, 0.5, 1.0}, {1.0, 0.0, 0.0}})->range, 6.05, 1e-12);
}

TEST_F(WorldFiles, IncludesFilesThatKnowItsMaterials) {
  write("parts/table.yaml", "discs: [{centre: [1, 0], radius: 0.1, material: oak}]");
  const auto world = World::readFile(write(
      "w.yaml", "materials: {oak: {reflectivity: 0.4}}\ninclude: [{file: parts/table.yaml}]"));
  ASSERT_EQ(world.discs().size(), 1u);
  EXPECT_EQ(world.materials()[world.discs()[0].material].name, "oak");
}

TEST_F(WorldFiles, PlacesWhatItIncludesWithinWhatThatIncludes) {
  write("rooms.yaml", "rooms: {a: {size: [4, 2]}}");
  write("inner.yaml", "rooms: rooms.yaml\nboxes: [{centre: [1, 0], size: [0.2, 0.2]}]");
  write("middle.yaml",
        "include: [{file: inner.yaml, pose: [0, 1, 0]}]\n"
        "discs: [{centre: [2, 0], radius: 0.1}]\n"
        "segments: [{from: [3, 0], to: [3, 1]}]");
  const auto world = World::readFile(
      write("outer.yaml", "include: [{file: middle.yaml, pose: [5, 0, 1.5707963267948966]}]"));
  ASSERT_EQ(world.segments().size(), 9u);
  EXPECT_TRUE(world.segments()[0].segment.start.isApprox(Eigen::Vector2d(5.0, -2.0), 1e-9));
  EXPECT_TRUE(world.segments()[4].segment.midpoint().isApprox(Eigen::Vector2d(4.1, 1.0), 1e-9));
  EXPECT_TRUE(world.segments()[8].segment.end.isApprox(Eigen::Vector2d(4.0, 3.0), 1e-9));
  EXPECT_TRUE(world.discs()[0].centre.isApprox(Eigen::Vector2d(5.0, 2.0), 1e-9));
  const auto box = world.plates()[0].corners;
  EXPECT_TRUE((0.5 * (box[0] + box[2])).isApprox(Eigen::Vector2d(4.0, 1.0), 1e-9));
}

TEST_F(WorldFiles, RefusesToIncludeItselfOrWhatIsNotThere) {
  write("a.yaml", "include: [{file: b.yaml}]");
  const std::string b = write("b.yaml", "include: [{file: a.yaml}]");
  EXPECT_THROW(World::readFile(b), config::Error);
  const std::string c = write("c.yaml", "include: [{file: missing.yaml}]");
  EXPECT_THROW(World::readFile(c), config::Error);
  EXPECT_THROW(World::readFile((folder_ / "nowhere.yaml").string()), config::Error);
}

TEST(WorldFile, ShippedWorldsLoadAndAreClosed) {
  const std::string folder = SIGHTLINE_SOURCE_DIR "/config/";
  for (const std::string name : {"floor", "living_room", "office", "corridor", "manipulator_lab"}) {
    const World world = World::readFile(folder + "worlds/" + name + ".yaml");
    const RoomMap rooms = RoomMap::readFile(folder + "rooms/" + name + ".yaml");
    EXPECT_FALSE(world.discs().empty()) << name;
    for (const Room& room : rooms.rooms()) {
      for (int degree = 0; degree < 360; ++degree) {
        const double angle = geometry::radians(degree);
        const Eigen::Vector3d middle(room.T_map_room.x(), room.T_map_room.y(), 2.5);
        EXPECT_TRUE(world.cast({middle, {std::cos(angle), std::sin(angle), 0.0}}))
            << room.name << " of " << name;
      }
    }
  }
}

TEST(WorldFile, RoomsOfTheFloorHaveTheSizesOfThePaper) {
  const auto map = RoomMap::readFile(SIGHTLINE_SOURCE_DIR "/config/rooms/floor.yaml");
  const auto size = [&](const char* name) {
    const Room& room = map.rooms()[*map.find(name)];
    return Eigen::Vector2d(room.walls[0].segment.length(), room.walls[1].segment.length());
  };
  EXPECT_TRUE(size("living_room").isApprox(Eigen::Vector2d(8.6, 5.0)));
  EXPECT_TRUE(size("office").isApprox(Eigen::Vector2d(5.0, 3.0)));
  EXPECT_TRUE(size("corridor").isApprox(Eigen::Vector2d(55.0, 2.3)));
  EXPECT_EQ(map.doors().size(), 3u);
}

}  // namespace
}  // namespace sightline::world
