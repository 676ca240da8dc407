#include <gmock/gmock.h>

#include "config_error.h"
#include "mapped_floor.h"
#include "sightline/config/node.h"
#include "temporary_folder.h"

namespace sightline::mapping {
namespace {

using testing::HasSubstr;
using world::Occupancy;

constexpr double kCell = 0.05;

const char* const kGridFloor = R"(
rooms:
  left: {size: [6.0, 4.0], pose: [0.0, 0.0, 0.0]}
  right: {size: [4.0, 4.0], pose: [5.15, 0.0, 0.0]}
  shut: {size: [3.0, 2.4], pose: [0.3, 3.4, 0.0]}
doors:
  - {between: [left, right], at: [3.07, 0.4], width: 0.9}
)";

// A grid of rooms, turned as the map of a map_server may be.
GridMap gridOf(const world::RoomMap& rooms, double turn) {
  GridMap grid;
  grid.cells = world::drawRooms(rooms, kCell);
  grid.T_map_grid = geometry::Pose2(0.0, 0.0, turn) * geometry::Pose2(grid.cells.origin, 0.0);
  grid.cells.origin.setZero();
  return grid;
}

class GridRoomsTest : public testing::TestWithParam<double> {};

TEST_P(GridRoomsTest, AreThoseThatWereDrawn) {
  const world::RoomMap truth(config::Node::parse(kGridFloor, "rooms"));
  const FittedRooms fitted = fitRooms(surveyGrid(gridOf(truth, GetParam()), kMiddleOfCell), {});
  const auto errors = test::FloorComparison(fitted, truth, geometry::Pose2(0.0, 0.0, -GetParam()))
                          .errors(test::FloorComparison::Frame::kGiven);
  EXPECT_EQ(errors.found, 3U);
  EXPECT_EQ(errors.invented, 0U);
  EXPECT_EQ(errors.unmatched_sides, 0U);
  EXPECT_EQ(errors.missing_doors, 0U);
  ASSERT_EQ(fitted.doors.size(), 1U);
  EXPECT_LT(errors.door_place.at(0), 0.05);
  EXPECT_LT(errors.door_width.at(0), 0.1);
  ASSERT_EQ(errors.sides.size(), 12U);
  for (const auto& side : errors.sides) EXPECT_LT(std::abs(side.offset), 0.5 * kCell + 0.001);
}

INSTANTIATE_TEST_SUITE_P(Turns, GridRoomsTest, testing::Values(0.0, 0.3));

// Walls that lie 7° across the cells are seen in the mean of many.
TEST(GridRooms, AcrossTheCellsAreNearer) {
  const world::RoomMap truth(
      config::Node::parse("rooms:\n  hall: {size: [6.0, 4.0], pose: [1.0, 2.0, 0.12]}\n", "rooms"));
  const FittedRooms fitted = fitRooms(surveyGrid(gridOf(truth, 0.0), kMiddleOfCell), {});
  const auto errors =
      test::FloorComparison(fitted, truth, {}).errors(test::FloorComparison::Frame::kGiven);
  ASSERT_EQ(errors.found, 1U);
  for (const auto& side : errors.sides) {
    EXPECT_LT(std::abs(side.offset), 0.2 * kCell);
    EXPECT_LT(std::abs(side.angle), 0.003);
  }
}

TEST(GridRooms, TheSurfaceMayBeTheEdgeOfTheCell) {
  const world::RoomMap truth(config::Node::parse("rooms:\n  hall: {size: [5.0, 4.0]}\n", "rooms"));
  const auto widthWith = [&](double surface) {
    const FittedRooms fitted = fitRooms(surveyGrid(gridOf(truth, 0.0), surface), {});
    return fitted.rooms.at(0).area() / 5.0;
  };
  EXPECT_NEAR(widthWith(0.5) - widthWith(0.0), kCell * 9.0 / 5.0, 0.02);
}

class GridFileTest : public testing::Test {
 protected:
  // A map of 3 x 2 cells: occupied, free, unknown; free, free, occupied.
  std::string write(const std::string& image, const std::string& more = "") {
    folder_.write("map.pgm", image);
    return folder_.write("map.yaml",
                         "image: map.pgm\nresolution: 0.1\norigin: [1.0, 2.0, 0.0]\nnegate: 0\n"
                         "occupied_thresh: 0.65\nfree_thresh: 0.196\n" +
                             more);
  }
  static std::string image(const std::string& greys) { return "P5\n3 2\n255\n" + greys; }

  test::TemporaryFolder folder_;
};

TEST_F(GridFileTest, IsReadAsTheMapServerReadsIt) {
  const auto map = readGridMap(write(image(std::string("\x00\xfe\xcd\xfe\xfe\x00", 6))));
  EXPECT_EQ(map.T_map_grid.x(), 1.0);
  EXPECT_EQ(map.T_map_grid.y(), 2.0);
  ASSERT_EQ(map.cells.width, 3U);
  ASSERT_EQ(map.cells.height, 2U);
  EXPECT_THAT(map.cells.cells,
              testing::ElementsAre(Occupancy::kFree, Occupancy::kFree, Occupancy::kOccupied,
                                   Occupancy::kOccupied, Occupancy::kFree, Occupancy::kUnknown));
}

TEST_F(GridFileTest, FaultsAreNamed) {
  const auto faultOf = [&](const std::string& path) {
    return std::string(test::errorOf([&] { readGridMap(path); }).what());
  };
  EXPECT_THAT(faultOf(write(image(std::string("\x00\xcd\xcd\xcd\xcd\x00", 6)))),
              HasSubstr("map.yaml:1: image: no cell of"));
  EXPECT_THAT(faultOf(write(image("\xfe\xfe\xfe\xfe\xfe\xfe"))), HasSubstr("is occupied"));
  EXPECT_THAT(faultOf(write("no image")), HasSubstr("no image can be read from"));
  EXPECT_THAT(faultOf(write(image("\xfe"), "mode: raw\n")), HasSubstr("mode: is neither"));
  EXPECT_THAT(faultOf(folder_.path("nowhere.yaml")), HasSubstr("nowhere.yaml"));
  EXPECT_THAT(faultOf(folder_.write("bare.yaml", "image: map.pgm\n")), HasSubstr("resolution"));
}

TEST_F(GridFileTest, AFloorWithoutRoomForARobotIsNamed) {
  const auto map = readGridMap(write(image(std::string("\x00\xfe\xcd\xfe\xfe\x00", 6))));
  EXPECT_THAT(test::errorOf([&] { surveyGrid(map, kMiddleOfCell); }).what(),
              HasSubstr("no room for a robot"));
}

}  // namespace
}  // namespace sightline::mapping
