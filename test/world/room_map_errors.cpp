// Faults of a rooms file, and the errors that tell them.
#include <gmock/gmock.h>

#include "config_error.h"
#include "sightline/world/room_map.h"

namespace sightline::world {
namespace {

using test::errorOf;
using testing::HasSubstr;

config::Error errorIn(const std::string& text) {
  return errorOf([&] { RoomMap(config::Node::parse(text, "rooms.yaml")); });
}

struct Fault {
  const char* text;
  int line;
  const char* key;
  const char* reason;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.text;
}

class RoomFault : public testing::TestWithParam<Fault> {};

TEST_P(RoomFault, IsNamedWithLineKeyAndReason) {
  const config::Error error = errorIn(GetParam().text);
  EXPECT_EQ(error.source(), "rooms.yaml");
  EXPECT_EQ(error.line(), GetParam().line) << error.what();
  EXPECT_EQ(error.key(), GetParam().key) << error.what();
  EXPECT_THAT(error.reason(), HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(Document, RoomFault,
                         testing::Values(Fault{"[1, 2]", 1, "", "expected a map"},
                                         Fault{"doors: []", 1, "", "missing key 'rooms'"},
                                         Fault{"rooms: {}", 1, "rooms", "no rooms"},
                                         Fault{"rooms:", 1, "rooms", "expected a map"},
                                         Fault{"rooms: [a]", 1, "rooms", "expected a map"},
                                         Fault{"rooms: {a: {size: [1, 1]}}\nrobots: 3", 2, "robots",
                                               "unknown key"},
                                         Fault{"rooms:\n  a: {size: [1, 1]}\n  a: {size: [2, 2]}",
                                               3, "rooms.a", "given twice"}));

INSTANTIATE_TEST_SUITE_P(
    Outline, RoomFault,
    testing::Values(
        Fault{"rooms:\n  a: {pose: [0, 0, 0]}", 2, "rooms.a", "either the key 'size'"},
        Fault{"rooms:\n  a: {size: [1, 1], polygon: [[0, 0], [1, 0], [0, 1]]}", 2, "rooms.a",
              "either the key 'size'"},
        Fault{"rooms:\n  a: 5", 2, "rooms.a", "expected a map"},
        Fault{"rooms:\n  a:\n    corners: [[0, 0], [1, -1]]", 3, "rooms.a.corners",
              "both have to be above 0"},
        Fault{"rooms:\n  a:\n    corners: [[0, 0], [1, 0], [1, 1]]", 3, "rooms.a.corners",
              "two opposite corners"},
        Fault{"rooms:\n  a:\n    corners: [[0, 0], [1, 1]]\n    pose: [0, 0, 0]", 4, "rooms.a.pose",
              "say where it is"},
        Fault{"rooms:\n  a:\n    size: [1, 1]\n    walls: {east: {sigma: [0, 0.1]}}", 4,
              "rooms.a.walls.east.sigma[0]", "0 is outside"},
        Fault{"rooms:\n  a:\n    size: [1, 1]\n    walls: {east: {sigma: [0.1, 4]}}", 4,
              "rooms.a.walls.east.sigma[1]", "4 is outside"},
        Fault{"rooms:\n  a:\n    size: [-1, 1]", 3, "rooms.a.size[0]",
              "-1 is outside [0.001, 1000000]"},
        Fault{"rooms:\n  a:\n    size: [1, 0]", 3, "rooms.a.size[1]",
              "0 is outside [0.001, 1000000]"},
        Fault{"rooms:\n  a:\n    size: [1, .inf]", 3, "rooms.a.size[1]", "inf is outside"},
        Fault{"rooms:\n  a:\n    size: [1, wide]", 3, "rooms.a.size[1]", "found 'wide'"},
        Fault{"rooms:\n  a:\n    size: [1, 2, 3]", 3, "rooms.a.size", "expected 2 numbers"},
        Fault{"rooms:\n  a:\n    size: 4", 3, "rooms.a.size", "expected a sequence"},
        Fault{"rooms:\n  a: {size: [1, 1], pose: [0, 0]}", 2, "rooms.a.pose", "expected 3 numbers"},
        Fault{"rooms:\n  a: {size: [1, 1], pose: [0, .nan, 0]}", 2, "rooms.a.pose[1]", "NaN"},
        Fault{"rooms:\n  a: {size: [1, 1], pose: [0, .inf, 0]}", 2, "rooms.a.pose[1]",
              "inf is outside"},
        Fault{"rooms:\n  a: {size: [1e200, 1]}", 2, "rooms.a.size[0]", "outside"},
        Fault{"rooms:\n  a: {size: [1, 1], pose: [1e200, 0, 0]}", 2, "rooms.a.pose[0]", "outside"},
        Fault{"rooms:\n  a: {size: [1, 1], colour: red}", 2, "rooms.a.colour", "unknown key"}));

INSTANTIATE_TEST_SUITE_P(
    Polygon, RoomFault,
    testing::Values(Fault{"rooms: {a: {polygon: [[0, 0], [1, 0]]}}", 1, "rooms.a.polygon",
                          "three corners"},
                    Fault{"rooms: {a: {polygon: [[0, 0], [0, 1], [1, 0]]}}", 1, "rooms.a.polygon",
                          "counter-clockwise"},
                    Fault{"rooms: {a: {polygon: [[0, 0], [1, 0], [2, 0]]}}", 1, "rooms.a.polygon",
                          "counter-clockwise"},
                    Fault{"rooms: {a: {polygon: [[0, 0], [3, 0], [3, 2], [0, 2], [0, 2]]}}", 1,
                          "rooms.a.polygon", "wall 3 has no length"},
                    Fault{"rooms: {a: {polygon: [[0, 0], [4, 0], [0, 3], [3, 1]]}}", 1,
                          "rooms.a.polygon", "walls 1 and 3 cross"},
                    Fault{"rooms: {a: {polygon: [[0, 0], [1, 0], [0, 1, 2]]}}", 1,
                          "rooms.a.polygon[2]", "expected 2 numbers"},
                    Fault{"rooms: {a: {polygon: [[0, 0], [1, x], [0, 1]]}}", 1,
                          "rooms.a.polygon[1][1]", "expected a number"}));

INSTANTIATE_TEST_SUITE_P(
    Walls, RoomFault,
    testing::Values(
        Fault{"rooms:\n  a:\n    size: [4, 3]\n    walls:\n      top: {open: true}", 5,
              "rooms.a.walls.top", "no such wall in this room; its walls are: south, east"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: [south]}", 2, "rooms.a.walls", "expected a map"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {thick: 1}}}", 2,
              "rooms.a.walls.south.thick", "unknown key"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {open: true, spans: [[0, 1]]}}}", 2,
              "rooms.a.walls.south", "not both"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {open: maybe}}}", 2,
              "rooms.a.walls.south.open", "true or false"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {spans: [[0, 5]]}}}", 2,
              "rooms.a.walls.south.spans[0]", "[0, 5] is no stretch of a wall of 4.000 m"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {spans: [[-1, 2]]}}}", 2,
              "rooms.a.walls.south.spans[0]", "no stretch"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {spans: [[2, 1]]}}}", 2,
              "rooms.a.walls.south.spans[0]", "no stretch"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {spans: [[4.005, 4.01]]}}}", 2,
              "rooms.a.walls.south.spans[0]", "no stretch"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {spans: [[0, 2], [1, 3]]}}}", 2,
              "rooms.a.walls.south.spans[1]", "overlaps the span before it"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {spans: [[2, 3], [0, 1]]}}}", 2,
              "rooms.a.walls.south.spans[1]", "overlaps the span before it"},
        Fault{"rooms:\n  a: {size: [4, 3], walls: {south: {spans: [0, 1]}}}", 2,
              "rooms.a.walls.south.spans[0]", "expected a sequence"}));

class DoorFault : public testing::TestWithParam<Fault> {};

TEST_P(DoorFault, IsNamedWithLineKeyAndReason) {
  const std::string rooms = "rooms:\n  a: {size: [4, 3]}\n  b: {size: [4, 3], pose: [4.1, 0, 0]}\n";
  const config::Error error = errorIn(rooms + "doors:\n  - " + GetParam().text + "\n");
  EXPECT_EQ(error.line(), GetParam().line) << error.what();
  EXPECT_EQ(error.key(), GetParam().key) << error.what();
  EXPECT_THAT(error.reason(), HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(
    Doors, DoorFault,
    testing::Values(
        Fault{"{between: [a, b], at: [9, 9], width: 1}", 5, "doors[0]", "joins nothing"},
        Fault{"{between: [a, b], at: [8.1, 0], width: 1}", 5, "doors[0]", "of 'a'"},
        Fault{"{between: [a, c], at: [2, 0], width: 1}", 5, "doors[0].between[1]",
              "no room is called 'c'"},
        Fault{"{between: [a, a], at: [2, 0], width: 1}", 5, "doors[0].between",
              "joins a room with itself"},
        Fault{"{between: [a], at: [2, 0], width: 1}", 5, "doors[0].between", "two rooms"},
        Fault{"{between: a, at: [2, 0], width: 1}", 5, "doors[0].between", "expected a sequence"},
        Fault{"{at: [2, 0], width: 1}", 5, "doors[0]", "missing key 'between'"},
        Fault{"{between: [a, b], width: 1}", 5, "doors[0]", "missing key 'at'"},
        Fault{"{between: [a, b], at: [2, 0]}", 5, "doors[0]", "missing key 'width'"},
        Fault{"{between: [a, b], at: [2, 0], width: -1}", 5, "doors[0].width",
              "-1 is outside [0.001, 1000000]"},
        Fault{"{between: [a, b], at: [2, 0], width: 900}", 5, "doors[0].width",
              "900 m is wider than wall east of 'a', 3.000 m"},
        Fault{"{between: [a, b], at: [2], width: 1}", 5, "doors[0].at", "expected 2 numbers"},
        Fault{"{between: [a, b], at: [2, 0], width: 1, threshold: 2}", 5, "doors[0].threshold",
              "true or false"},
        Fault{"{between: [a, b], at: [2, 0], width: 1, lock: 2}", 5, "doors[0].lock",
              "unknown key"},
        Fault{"door", 5, "doors[0]", "expected a map"}));

TEST(RoomMapFile, ThatIsMissingIsNamed) {
  const config::Error error = errorOf([] { RoomMap::readFile("/no/such/rooms.yaml"); });
  EXPECT_STREQ(error.what(), "/no/such/rooms.yaml: no such file, or not readable");
}

}  // namespace
}  // namespace sightline::world
