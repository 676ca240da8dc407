#include "sightline/config/fields.h"

#include <gmock/gmock.h>

#include "config_error.h"

namespace sightline::config {
namespace {

using test::errorOf;
using testing::ElementsAre;
using testing::HasSubstr;

enum class Colour { kRed, kGreen };

struct Lamp {
  double power = 5.0;
  Colour colour = Colour::kRed;

  void visit(FieldVisitor& visitor) {
    visitor.number("power", power, {"W", {0.0, 100.0}, "electric power"});
    visitor.choice("colour", colour, {"red", "green"}, "of its light");
  }
};

struct Desk {
  double width = 1.5;
  int drawers = 3;
  bool movable = false;
  std::string owner = "nobody";
  std::vector<double> shelves = {0.3, 0.6};
  Lamp lamp;

  void visit(FieldVisitor& visitor) {
    visitor.number("width", width, {"m", kPositive, "from side to side"});
    visitor.integer("drawers", drawers, {"1", {0.0, 10.0}, "number of drawers"});
    visitor.flag("movable", movable, "has castors");
    visitor.text("owner", owner, "who sits at it");
    visitor.numbers("shelves", shelves, {"m", kNotNegative, "heights of the shelves"});
    visitor.group("lamp", lamp);
  }
};

Desk readDesk(const std::string& text, UnknownKeys unknown = UnknownKeys::kRefuse) {
  Desk desk;
  read(Node::parse(text, "desk.yaml"), desk, unknown);
  return desk;
}

TEST(Read, TakesEveryKindOfField) {
  const Desk desk = readDesk(
      "width: 2\ndrawers: 4\nmovable: true\nowner: Ada\nshelves: [0.1, 0.2, 0.3]\n"
      "lamp: {power: 40, colour: green}\n");
  EXPECT_EQ(desk.width, 2.0);
  EXPECT_EQ(desk.drawers, 4);
  EXPECT_TRUE(desk.movable);
  EXPECT_EQ(desk.owner, "Ada");
  EXPECT_THAT(desk.shelves, ElementsAre(0.1, 0.2, 0.3));
  EXPECT_EQ(desk.lamp.power, 40.0);
  EXPECT_EQ(desk.lamp.colour, Colour::kGreen);
}

TEST(Read, KeepsWhatTheDocumentDoesNotName) {
  const Desk desk = readDesk("lamp: {colour: green}\n");
  EXPECT_EQ(desk.width, 1.5);
  EXPECT_EQ(desk.lamp.power, 5.0);
  EXPECT_EQ(desk.lamp.colour, Colour::kGreen);
}

TEST(Read, KeepsEverythingWhereNothingIsWritten) {
  for (const char* text : {"", "# all defaults\n", "{}", "lamp:\n", "lamp: {}\n"}) {
    const Desk desk = readDesk(text);
    EXPECT_EQ(desk.width, 1.5) << text;
    EXPECT_EQ(desk.lamp.power, 5.0) << text;
  }
}

TEST(Read, RefusesADocumentThatIsNoMap) {
  EXPECT_EQ(errorOf([] { readDesk("[1, 2]\n"); }).reason(), "expected a map");
  EXPECT_EQ(errorOf([] { readDesk("word\n"); }).reason(), "expected a map");
  const Error group = errorOf([] { readDesk("width: 2\nlamp: 4\n"); });
  EXPECT_STREQ(group.what(), "desk.yaml:2: lamp: expected a map");
}

TEST(Read, RefusesUnknownKeysWithTheirLine) {
  EXPECT_THAT(errorOf([] { readDesk("width: 2\nheigth: 1\n"); }).what(),
              HasSubstr("desk.yaml:2: heigth: unknown key; known are: width, drawers"));
  EXPECT_STREQ(errorOf([] { readDesk("lamp:\n  power: 1\n  color: red\n"); }).what(),
               "desk.yaml:3: lamp.color: unknown key; known are: power, colour");
}

TEST(Read, MayIgnoreUnknownKeysButNothingElse) {
  EXPECT_EQ(readDesk("other: 1\nwidth: 2\nlamp: {other: 1}\n", UnknownKeys::kIgnore).width, 2.0);
  EXPECT_THAT(errorOf([] { readDesk("width: -2\n", UnknownKeys::kIgnore); }).reason(),
              HasSubstr("outside"));
  EXPECT_EQ(errorOf([] { readDesk("width: 2\nwidth: 3\n", UnknownKeys::kIgnore); }).reason(),
            "given twice");
}

struct Fault {
  const char* text;
  const char* key;
  const char* reason;
};

class FaultyField : public testing::TestWithParam<Fault> {};

TEST_P(FaultyField, IsNamedWithLineAndReason) {
  const Error error = errorOf([] { readDesk(std::string("# a desk\n") + GetParam().text); });
  EXPECT_EQ(error.source(), "desk.yaml");
  EXPECT_EQ(error.line(), 2);
  EXPECT_EQ(error.key(), GetParam().key);
  EXPECT_THAT(error.reason(), HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, FaultyField,
    testing::Values(Fault{"width: wide", "width", "expected a number, found 'wide'"},
                    Fault{"width: 0", "width", "0 is outside > 0"},
                    Fault{"width: .nan", "width", "NaN"}, Fault{"width: .inf", "width", "outside"},
                    Fault{"width:", "width", "expected a number"},
                    Fault{"drawers: 2.5", "drawers", "expected a whole number, found '2.5'"},
                    Fault{"drawers: 11", "drawers", "11 is outside [0, 10]"},
                    Fault{"movable: 3", "movable", "expected true or false, found '3'"},
                    Fault{"owner: [a]", "owner", "expected a text"},
                    Fault{"shelves: 1", "shelves", "expected a sequence"},
                    Fault{"shelves: [1, -1]", "shelves[1]", "-1 is outside >= 0"},
                    Fault{"lamp: {power: 101}", "lamp.power", "101 is outside [0, 100]"},
                    Fault{"lamp: {colour: blue}", "lamp.colour", "'blue' is none of: red, green"}));

TEST(Validate, PassesDefaults) {
  validate(Desk{});
}

TEST(Validate, NamesKeyValueAndRange) {
  Desk desk;
  desk.lamp.power = 200.0;
  EXPECT_STREQ(errorOf([&] { validate(desk, "/robot"); }).what(),
               "/robot: lamp.power: 200 is outside [0, 100]");
  desk = {};
  desk.drawers = -1;
  EXPECT_STREQ(errorOf([&] { validate(desk); }).what(), "drawers: -1 is outside [0, 10]");
  desk = {};
  desk.shelves.push_back(-0.5);
  EXPECT_EQ(errorOf([&] { validate(desk); }).key(), "shelves");
}

TEST(Validate, RefusesWhatIsNoNumber) {
  Desk desk;
  desk.width = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(errorOf([&] { validate(desk); }).key(), "width");
  desk.width = std::numeric_limits<double>::infinity();
  EXPECT_EQ(errorOf([&] { validate(desk); }).key(), "width");
}

TEST(Describe, ListsEveryFieldInOrder) {
  const auto rows = describe<Desk>();
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[0].key, "width");
  EXPECT_EQ(rows[0].type, "double");
  EXPECT_EQ(rows[0].default_value, "1.5");
  EXPECT_EQ(rows[0].unit, "m");
  EXPECT_EQ(rows[0].range, "> 0");
  EXPECT_EQ(rows[0].meaning, "from side to side");
  EXPECT_EQ(rows[1].range, "[0, 10]");
  EXPECT_EQ(rows[2].default_value, "false");
  EXPECT_EQ(rows[3].default_value, "nobody");
  EXPECT_EQ(rows[4].default_value, "[0.3, 0.6]");
  EXPECT_EQ(rows[5].key, "lamp.power");
  EXPECT_EQ(rows[6].default_value, "red");
  EXPECT_EQ(rows[6].range, "red, green");
}

TEST(Describe, TellsTheValuesOfTheConfigurationItIsGiven) {
  Desk desk;
  desk.owner.clear();
  desk.lamp.colour = Colour::kGreen;
  const auto rows = describe(desk);
  EXPECT_EQ(rows[3].default_value, "(empty)");
  EXPECT_EQ(rows[6].default_value, "green");
}

}  // namespace
}  // namespace sightline::config
