#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "carmen_room.h"
#include "sightline/world/room_map.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::ProgramResult;
using test::runProgram;
using testing::HasSubstr;

std::string contentOf(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

class FitRoomsTest : public testing::Test {
 protected:
  // Makes a bag of a log, and fits rooms to it.
  ProgramResult fit(const std::string& log, const std::string& out = "rooms.yaml") {
    const std::string path = folder_.write("a.clf", log);
    EXPECT_EQ(runProgram("carmen_to_bag", path + " " + folder_.path("a.bag")).status, 0);
    return runProgram("fit_rooms", folder_.path("a.bag") + " --out " + folder_.path(out));
  }

  test::TemporaryFolder folder_;
};

TEST_F(FitRoomsTest, FitsTheRoomThatWasDriven) {
  const auto result = fit(test::carmenRoomLog(80));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("rooms: 1, with 0 doors"));
  EXPECT_THAT(result.output, HasSubstr("the rooms keep their own recording"));
  const auto map = world::RoomMap::readFile(folder_.path("rooms.yaml"));
  ASSERT_EQ(map.rooms().size(), 1U);
  std::vector<double> sides;
  for (const auto& wall : map.rooms()[0].walls) sides.push_back(wall.segment.length());
  std::sort(sides.begin(), sides.end());
  EXPECT_NEAR(sides.front(), test::kRoomWidth, 0.02);
  // The wall behind the start is never seen.
  EXPECT_LT(sides.back(), test::kRoomLength + 0.02);
  EXPECT_THAT(contentOf(folder_.path("rooms.png")), HasSubstr("PNG"));
}

TEST_F(FitRoomsTest, TheSameRecordingGivesTheSameFile) {
  ASSERT_EQ(fit(test::carmenRoomLog(80), "first.yaml").status, 0);
  ASSERT_EQ(fit(test::carmenRoomLog(80), "second.yaml").status, 0);
  EXPECT_EQ(contentOf(folder_.path("first.yaml")), contentOf(folder_.path("second.yaml")));
  EXPECT_EQ(contentOf(folder_.path("first.png")), contentOf(folder_.path("second.png")));
}

// After 18 s the robot has left the room, and nothing is seen of what was.
TEST_F(FitRoomsTest, PartsThatNothingJoinsAreNoRooms) {
  const auto result = fit(test::carmenRoomLog(150));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("it falls into 2 parts that nothing joins: the scans from"));
}

TEST_F(FitRoomsTest, OneScanIsNoDrive) {
  const auto result = fit(test::carmenRoomLog(1));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("a.bag: it holds one scan that can be used"));
}

TEST_F(FitRoomsTest, ARobotThatStandsSeesNoRooms) {
  std::string log = "# CARMEN Logfile\nPARAM robot_front_laser_max 80.99 1 host 1\n";
  for (int i = 0; i < 50; ++i) {
    log += test::flaserLineAt(0.0, 0.2 * i);
  }
  const auto result = fit(log);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("the scanner did not move"));
}

// Two rooms as a grid of a map_server.
class GridToolTest : public FitRoomsTest {
 protected:
  std::string grid() {
    const std::string rooms = folder_.write(
        "drawn.yaml",
        "rooms:\n  a: {size: [6.0, 4.0]}\n  b: {size: [3.0, 4.0], pose: [4.65, 0.0, 0.0]}\n"
        "doors:\n  - {between: [a, b], at: [3.07, 0.5], width: 0.9}\n");
    EXPECT_EQ(runProgram("rooms_to_map", rooms + " " + folder_.path("map.yaml")).status, 0);
    return folder_.path("map.yaml");
  }
  ProgramResult fitGrid(const std::string& more) {
    return runProgram("fit_rooms",
                      "--grid " + grid() + " --out " + folder_.path("rooms.yaml") + " " + more);
  }
};

TEST_F(GridToolTest, GivesTheRoomsThatWereDrawn) {
  const auto result = fitGrid("");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("rooms: 2, with 1 doors"));
  const auto map = world::RoomMap::readFile(folder_.path("rooms.yaml"));
  ASSERT_EQ(map.rooms().size(), 2U);
  EXPECT_TRUE(map.rooms()[0].walls[0].sigma);
  EXPECT_THAT(contentOf(folder_.path("rooms.png")), HasSubstr("PNG"));
}

TEST_F(GridToolTest, KeepsWhatPeopleHaveNamed) {
  const std::string kept =
      folder_.write("kept.yaml",
                    "rooms:\n  'the kitchen': {size: [6.0, 4.0], pose: [10.0, 5.0], turn_deg: 0}\n"
                    "  hall: {size: [2.0, 2.0], pose: [10.0, 8.2, 0.0]}\n"
                    "doors:\n  - {between: ['the kitchen', hall], at: [10.0, 7.1], width: 0.8}\n");
  const auto result = fitGrid("--keep " + kept);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("kept.yaml: rooms: the recording does not fit"));
  const std::string sure = folder_.write(
      "sure.yaml",
      "rooms:\n  'the kitchen': {size: [6.0, 4.0], pose: [10.0, 5.0, 0.0], walls: {east: "
      "{spans: [[0, 2.05], [2.95, 4]]}}}\n");
  const auto added = fitGrid("--keep " + sure);
  EXPECT_EQ(added.status, 0) << added.output;
  EXPECT_THAT(added.output, HasSubstr("kept: 1 rooms, 0 doors; added: 1 rooms, 1 doors"));
  const auto map = world::RoomMap::readFile(folder_.path("rooms.yaml"));
  ASSERT_EQ(map.rooms().size(), 2U);
  EXPECT_EQ(map.rooms()[0].name, "the kitchen");
  EXPECT_EQ(map.rooms()[0].T_map_room.x(), 10.0);
  EXPECT_NEAR(map.rooms()[1].T_map_room.x(), 14.65, 0.06);
}

TEST_F(GridToolTest, FaultsAreNamed) {
  const auto missing =
      runProgram("fit_rooms", "--grid nowhere.yaml --out " + folder_.path("r.yaml"));
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.output, HasSubstr("nowhere.yaml"));
  EXPECT_EQ(fitGrid("--surface 2").status, 2);
  EXPECT_EQ(fitGrid(folder_.path("map.yaml")).status, 2);
  EXPECT_EQ(runProgram("fit_rooms", "--out " + folder_.path("r.yaml")).status, 2);
}

TEST_F(FitRoomsTest, AFolderThatIsNotThereIsNamed) {
  const auto result = fit(test::carmenRoomLog(80), "nowhere/rooms.yaml");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("nowhere/rooms.yaml: cannot be written"));
}

TEST_F(FitRoomsTest, ABagThatIsNoneIsNamed) {
  const std::string path = folder_.write("b.bag", "no bag");
  const auto result = runProgram("fit_rooms", path + " --out " + folder_.path("rooms.yaml"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("b.bag"));
}

}  // namespace
}  // namespace sightline
