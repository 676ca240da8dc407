// The kinds of settings beside numbers, flags and texts.
#include <array>
#include <cstdlib>

#include <gmock/gmock.h>

#include "config_error.h"
#include "sightline/config/fields.h"
#include "sightline/config/yaml_writer.h"
#include "temporary_folder.h"

namespace sightline::config {
namespace {

using test::errorOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Wheel {
  double radius = 0.1;

  void visit(FieldVisitor& visitor) {
    visitor.number("radius", radius, {"m", {0.01, 1.0}, "to the ground"});
  }
};

struct Cart {
  std::vector<std::string> topics = {"scan"};
  std::string map;
  std::array<double, 2> sigmas = {0.3, 0.1};
  geometry::Pose2 start;
  std::optional<geometry::Pose2> goal;
  bool publish = false;
  std::optional<Wheel> spare;
  std::map<std::string, geometry::Pose2> mountings;
  std::map<std::string, Wheel> wheels;

  void visit(FieldVisitor& visitor) {
    visitor.texts("topics", topics, "what it listens to");
    visitor.path("map", map, "where it drives");
    visitor.numbers("sigmas", sigmas, {"m, rad", {0.0, 10.0}, "of its pose"});
    visitor.pose("start", start, "where it begins");
    visitor.pose("goal", goal, "where it ends");
    visitor.flag("publish", publish, "says where it is");
    visitor.group("spare", spare);
    visitor.entries("mountings", mountings, "where its scanners are");
    visitor.entries("wheels", wheels, "what it rolls on");
  }
};

Cart readCart(const std::string& text) {
  Cart cart;
  read(Node::parse(text, "cart.yaml"), cart);
  return cart;
}

Error cartError(const std::string& text) {
  return errorOf([&] { readCart("# a cart\n" + text); });
}

void expectPose(const std::optional<geometry::Pose2>& pose, double x, double y, double yaw) {
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->coordinates(), Eigen::Vector3d(x, y, yaw));
}

TEST(ListOfTexts, IsASequenceOrOneTextOfWords) {
  for (const char* text : {"[front, rear]", "front rear", "front,rear", "'front , rear '",
                           "'[front, rear]'", "\n  - front\n  - rear"}) {
    EXPECT_THAT(readCart(std::string("topics: ") + text).topics, ElementsAre("front", "rear"))
        << text;
  }
  EXPECT_THAT(readCart("topics: scan").topics, ElementsAre("scan"));
  EXPECT_THAT(readCart("topics: [scan]").topics, ElementsAre("scan"));
  for (const char* text : {"[]", "''", "' , '"}) {
    EXPECT_THAT(readCart(std::string("topics: ") + text).topics, IsEmpty()) << text;
  }
}

TEST(ListOfTexts, HoldsTextsAlone) {
  EXPECT_STREQ(cartError("topics: [scan, [a]]").what(), "cart.yaml:2: topics[1]: expected a text");
  EXPECT_STREQ(cartError("topics: {a: 1}").what(), "cart.yaml:2: topics: expected a sequence");
  EXPECT_STREQ(cartError("topics: '[scan'").what(),
               "cart.yaml:2: topics: expected a sequence, found '[scan'");
}

TEST(PathOfAFile, IsRelativeToTheFileThatNamesIt) {
  const test::TemporaryFolder folder;
  Cart cart;
  read(Node::readFile(folder.write("cart.yaml", "map: maps/../rooms.yaml\n")), cart);
  EXPECT_EQ(cart.map, folder.path("rooms.yaml"));
  read(Node::readFile(folder.write("cart.yaml", "map: /rooms.yaml\n")), cart);
  EXPECT_EQ(cart.map, "/rooms.yaml");
  read(Node::readFile(folder.write("cart.yaml", "map: ''\n")), cart);
  EXPECT_EQ(cart.map, "");
}

TEST(PathOfAFile, IsRelativeToTheWorkingDirectoryWhereNoFileNamesIt) {
  Cart cart;
  read(Node(YAML::Load("map: rooms.yaml"), "/robot/tracker"), cart);
  EXPECT_EQ(cart.map, "rooms.yaml");
}

TEST(PathOfAFile, MayBeginAtHome) {
  const char* const home = std::getenv("HOME");
  if (!home) GTEST_SKIP() << "there is no HOME";
  EXPECT_EQ(readCart("map: ~/rooms.yaml").map, std::string(home) + "/rooms.yaml");
  EXPECT_EQ(readCart("map: a~/rooms.yaml").map, "a~/rooms.yaml");
}

TEST(FixedNumbers, AreOfTheirCount) {
  EXPECT_THAT(readCart("sigmas: [1, 2]").sigmas, ElementsAre(1.0, 2.0));
  EXPECT_THAT(readCart("sigmas: '[1, 2]'").sigmas, ElementsAre(1.0, 2.0));
  EXPECT_STREQ(cartError("sigmas: [1, 2, 3]").what(),
               "cart.yaml:2: sigmas: expected 2 numbers, found 3");
  EXPECT_STREQ(cartError("sigmas: [1, 11]").what(),
               "cart.yaml:2: sigmas[1]: 11 is outside [0, 10]");
  EXPECT_STREQ(cartError("sigmas: '[1, 11]'").what(),
               "cart.yaml:2: sigmas[1]: 11 is outside [0, 10]");
}

TEST(PoseSetting, IsThreeNumbers) {
  expectPose(readCart("start: [1, 2, 0.5]").start, 1.0, 2.0, 0.5);
  expectPose(readCart("goal: '[1, -2, 0.5]'").goal, 1.0, -2.0, 0.5);
}

TEST(PoseSetting, MayBeMissingWhereItIsOptional) {
  EXPECT_FALSE(readCart("").goal);
  for (const char* text : {"[]", "''", "'[]'", "~"}) {
    EXPECT_FALSE(readCart(std::string("goal: ") + text).goal) << text;
  }
  for (const char* text : {"start: []", "goal: 3", "goal: 1 2 3", "goal: [1, 2]", "goal: {x: 1}"}) {
    EXPECT_EQ(cartError(text).reason(), "expected a pose: [x, y, yaw] in m, m, rad") << text;
    EXPECT_EQ(cartError(text).line(), 2) << text;
  }
  EXPECT_THAT(cartError("goal: [1, .nan, 2]").what(), HasSubstr("cart.yaml:2: goal[1]: "));
}

TEST(Flag, MayBeOneOrZero) {
  EXPECT_TRUE(readCart("publish: 1").publish);
  EXPECT_FALSE(readCart("publish: 0").publish);
}

TEST(OptionalGroup, IsThereWhereTheDocumentHasItsKey) {
  EXPECT_FALSE(readCart("").spare);
  EXPECT_EQ(readCart("spare:").spare.value().radius, 0.1);
  EXPECT_EQ(readCart("spare: {radius: 0.5}").spare.value().radius, 0.5);
  EXPECT_STREQ(cartError("spare: 3").what(), "cart.yaml:2: spare: expected a map");
  EXPECT_STREQ(cartError("spare:\n  width: 3").what(),
               "cart.yaml:3: spare.width: unknown key; known are: radius");
}

TEST(Entries, AreNamedByTheDocument) {
  const Cart cart = readCart(
      "mountings: {laser: [0.2, 0, 0], rear: '[-0.2, 0, 3]'}\n"
      "wheels: {left: {}, right: {radius: 0.5}}\n");
  ASSERT_EQ(cart.mountings.size(), 2u);
  expectPose(cart.mountings.at("laser"), 0.2, 0.0, 0.0);
  expectPose(cart.mountings.at("rear"), -0.2, 0.0, 3.0);
  ASSERT_EQ(cart.wheels.size(), 2u);
  EXPECT_EQ(cart.wheels.at("left").radius, 0.1);
  EXPECT_EQ(cart.wheels.at("right").radius, 0.5);
}

TEST(Entries, AreReadLikeAnyOtherField) {
  EXPECT_THAT(cartError("mountings:\n  laser: [1, 2]").what(),
              HasSubstr("cart.yaml:3: mountings.laser: expected a pose"));
  EXPECT_STREQ(cartError("wheels:\n  left: {radius: 2}").what(),
               "cart.yaml:3: wheels.left.radius: 2 is outside [0.01, 1]");
  EXPECT_EQ(cartError("mountings: [1]").reason(), "expected a map");
  EXPECT_EQ(cartError("wheels: {a: {}, a: {}}").reason(), "given twice");
}

Cart fullCart() {
  Cart cart;
  cart.topics = {"a, b", "", "\"c\""};
  cart.map = "maps/rooms.yaml";
  cart.sigmas = {1.0 / 3.0, 2.0};
  cart.start = {1.0, 2.0, -3.0};
  cart.goal = geometry::Pose2(0.1, 0.2, 0.3);
  cart.publish = true;
  cart.spare = Wheel{0.7};
  cart.mountings["base: laser #1"] = {1.0 / 7.0, 0.0, 3.0};
  cart.wheels["left"] = {0.25};
  return cart;
}

TEST(EveryKind, IsWrittenAndReadBack) {
  const Cart read = readCart(toYaml(fullCart()));
  EXPECT_EQ(read.topics, fullCart().topics);
  EXPECT_EQ(read.map, "maps/rooms.yaml");
  EXPECT_EQ(read.sigmas, fullCart().sigmas);
  expectPose(read.start, 1.0, 2.0, -3.0);
  expectPose(read.goal, 0.1, 0.2, 0.3);
  EXPECT_TRUE(read.publish);
  EXPECT_EQ(read.spare.value().radius, 0.7);
  expectPose(read.mountings.at("base: laser #1"), 1.0 / 7.0, 0.0, 3.0);
  EXPECT_EQ(read.wheels.at("left").radius, 0.25);
  EXPECT_EQ(toYaml(readCart(toYaml(Cart()))), toYaml(Cart()));
  EXPECT_THAT(toYaml(Cart()), Not(HasSubstr("spare")));
}

TEST(EveryKind, IsChecked) {
  validate(fullCart());
  Cart cart = fullCart();
  cart.sigmas[1] = -1.0;
  EXPECT_STREQ(errorOf([&] { validate(cart); }).what(), "sigmas: -1 is outside [0, 10]");
  cart = fullCart();
  cart.wheels["left"].radius = 2.0;
  EXPECT_EQ(errorOf([&] { validate(cart); }).key(), "wheels.left.radius");
  cart = fullCart();
  cart.spare->radius = 2.0;
  EXPECT_EQ(errorOf([&] { validate(cart); }).key(), "spare.radius");
  cart = fullCart();
  cart.goal = geometry::Pose2(std::nan(""), 0.0, 0.0);
  EXPECT_EQ(errorOf([&] { validate(cart); }).key(), "goal");
}

TEST(EveryKind, MayBeConstant) {
  static const Cart cart = fullCart();
  validate(cart);
  EXPECT_EQ(toYaml(cart), toYaml(fullCart()));
}

TEST(EveryKind, IsDescribed) {
  std::vector<std::string> lines;
  for (const auto& row : describe<Cart>()) {
    lines.push_back(row.key + ", " + row.type + ", " + row.default_value + ", " + row.unit);
  }
  EXPECT_THAT(lines,
              ElementsAre("topics, list of string, [scan], -", "map, path, (empty), -",
                          "sigmas, 2 doubles, [0.3, 0.1], m, rad",
                          "start, pose, [0, 0, 0], m, m, rad", "goal, pose or [], [], m, m, rad",
                          "publish, bool, false, -", "spare.radius, double, 0.1, m",
                          "mountings, map, {}, -", "mountings.NAME, pose, [0, 0, 0], m, m, rad",
                          "wheels, map, {}, -", "wheels.NAME.radius, double, 0.1, m"));
}

}  // namespace
}  // namespace sightline::config
